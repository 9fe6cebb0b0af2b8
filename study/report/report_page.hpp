#pragma once

#include <span>
#include <string>

#include "study/report/page_input.hpp"

namespace rtu::study {

/// Throws Error when this program was built without the charting library.
void check_page_library();

/// One self-contained HTML page with all results, in the order of the inputs, runs first. The same inputs
/// give the same bytes. Throws Error as check_page_library() does.
[[nodiscard]] std::string report_page(std::span<const PageInput> inputs);

}  // namespace rtu::study
