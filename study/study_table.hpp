#pragma once

#include <string>
#include <vector>

#include "study/text_table.hpp"

namespace rtu::study {

/// A table of finished cells, for text and HTML alike.
struct StudyTable {
    std::string title;
    std::string note;  ///< below the table; may be empty
    std::vector<TextTable::Column> columns;
    std::vector<std::vector<std::string>> rows;
};

}  // namespace rtu::study
