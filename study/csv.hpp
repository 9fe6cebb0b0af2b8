#pragma once

#include <string>
#include <vector>

namespace rtu::study {

/// One line of CSV as RFC 4180 has it: cells quoted where they must be, ended by CR LF.
[[nodiscard]] std::string csv_line(std::vector<std::string> cells);

}  // namespace rtu::study
