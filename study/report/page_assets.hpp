#pragma once

#include <string_view>

namespace rtu::study {

/// Files of study/report/page and of the charting library, as they were when the program was built.
struct PageAssets {
    std::string_view
        frame;  ///< HTML with the marks {{style}}, {{licence}}, {{library}}, {{data}}, {{script}}
    std::string_view style;    ///< CSS
    std::string_view script;   ///< JavaScript
    std::string_view library;  ///< JavaScript of the charting library; empty: built without
    std::string_view licence;  ///< its licences, as a comment of HTML
};

[[nodiscard]] PageAssets page_assets();

}  // namespace rtu::study
