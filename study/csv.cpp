#include "study/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace rtu::study {
namespace {

std::string csv_cell(std::string_view cell) {
    if (cell.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(cell);
    std::string out;
    for (const char c : cell) out.append(c == '"' ? 2 : 1, c);
    return fmt::format("\"{}\"", out);
}

}  // namespace

std::string csv_line(std::vector<std::string> cells) {
    for (std::string& cell : cells) cell = csv_cell(cell);
    return fmt::format("{}\r\n", fmt::join(cells, ","));
}

}  // namespace rtu::study
