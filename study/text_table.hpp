#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rtu::study {

/// A table of aligned columns. A column's header may have two lines ("Box tests\nper ray"): the second is its
/// unit. Left-aligned columns hold names, right-aligned ones numbers.
class TextTable {
  public:
    enum class Align : std::uint8_t { Left, Right };
    struct Column {
        std::string header;
        Align align = Align::Right;
    };
    explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

    /// One cell for each column.
    void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    /// A line across the table, before the next row.
    void add_rule() { rows_.emplace_back(); }
    /// The table, each line indented by two spaces and ended by a line feed; columns stand two spaces apart.
    [[nodiscard]] std::string text() const;

  private:
    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;  // an empty row is a rule
};

inline constexpr auto left_aligned = TextTable::Align::Left;

/// 1234567 as "1,234,567".
[[nodiscard]] std::string grouped(std::uint64_t value);
/// A value >= 0 with that many decimals and thousands separators: "1,234.50".
[[nodiscard]] std::string fixed(double value, int decimals);
/// part / whole in percent with two decimals; "-" for an empty whole.
[[nodiscard]] std::string percent(std::uint64_t part, std::uint64_t whole);
/// value / count with two decimals; "-" for a count of 0.
[[nodiscard]] std::string per(std::uint64_t value, std::uint64_t count);
/// Bytes in the binary unit that leaves at most four digits before the point: "512 B", "3.81 MiB".
[[nodiscard]] std::string byte_size(std::uint64_t bytes);

}  // namespace rtu::study
