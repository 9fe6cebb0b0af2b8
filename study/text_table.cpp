#include "study/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "model/error.hpp"

namespace rtu::study {
namespace {

// "first\nsecond" -> its two lines; the second is empty for a header of one line.
std::pair<std::string_view, std::string_view> header_lines(std::string_view header) {
    const std::size_t end = header.find('\n');
    if (end == std::string_view::npos) return {header, {}};
    return {header.substr(0, end), header.substr(end + 1)};
}

std::string aligned(std::string_view text, std::size_t width, TextTable::Align align) {
    return align == TextTable::Align::Left ? fmt::format("  {:<{}}", text, width)
                                           : fmt::format("  {:>{}}", text, width);
}

void append_line(std::string& out, std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
}

std::string with_separators(std::string_view digits) {
    std::string out;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) out.push_back(',');
        out.push_back(digits[i]);
    }
    return out;
}

}  // namespace

std::string TextTable::text() const {
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        const auto [first, second] = header_lines(columns_[i].header);
        std::size_t width = std::max(first.size(), second.size());
        for (const auto& row : rows_) {
            RTU_CHECK(row.empty() || row.size() == columns_.size(), "a table row of {} cells", row.size());
            if (!row.empty()) width = std::max(width, row[i].size());
        }
        widths.push_back(width);
    }
    std::string top, bottom, rule, out;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        const auto [first, second] = header_lines(columns_[i].header);
        top += aligned(first, widths[i], columns_[i].align);
        bottom += aligned(second, widths[i], columns_[i].align);
        rule += "  " + std::string(widths[i], '-');
    }
    append_line(out, top);
    if (bottom.find_first_not_of(' ') != std::string::npos) append_line(out, bottom);
    append_line(out, rule);
    for (const auto& row : rows_) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) line += aligned(row[i], widths[i], columns_[i].align);
        append_line(out, row.empty() ? rule : line);
    }
    return out;
}

std::string grouped(std::uint64_t value) { return with_separators(std::to_string(value)); }

std::string fixed(double value, int decimals) {
    const std::string text = fmt::format("{:.{}f}", value, decimals);
    const std::string_view whole = std::string_view(text).substr(0, text.find('.'));
    return with_separators(whole) + text.substr(whole.size());
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? "-" : fixed(100.0 * double(part) / double(whole), 2);
}

std::string per(std::uint64_t value, std::uint64_t count) {
    return count == 0 ? "-" : fixed(double(value) / double(count), 2);
}

std::string byte_size(std::uint64_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    constexpr std::array<std::string_view, 4> units{"KiB", "MiB", "GiB", "TiB"};
    double value = double(bytes) / 1024;
    std::size_t unit = 0;
    for (; value >= 1024 && unit + 1 < units.size(); ++unit) value /= 1024;
    return fmt::format("{} {}", fixed(value, 2), units[unit]);
}

}  // namespace rtu::study
