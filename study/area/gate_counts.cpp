#include "study/area/gate_counts.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "model/error.hpp"
#include "study/area/embedded_gates.hpp"

namespace rtu::study {
namespace {

std::vector<std::string_view> split_at(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        parts.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

double number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    RTU_CHECK(error == std::errc{} && end == text.data() + text.size() && value >= 0,
              "gates.csv: expected a count, got '{}'", text);
    return value;
}

CountedUnit parse_row(std::string_view line) {
    const auto cells = split_at(line, ',');
    RTU_CHECK(cells.size() == 7, "gates.csv: expected 7 cells, got '{}'", line);
    return {std::string(cells[0]),
            {number(cells[1]), number(cells[2]), number(cells[3]), number(cells[4]), number(cells[5]),
             number(cells[6])}};
}

}  // namespace

GateCounts& GateCounts::operator+=(const GateCounts& other) {
    gates += other.gates;
    register_bits += other.register_bits;
    register_gates += other.register_gates;
    multipliers += other.multipliers;
    adders += other.adders;
    depth = std::max(depth, other.depth);
    return *this;
}

GateCounts times(double count, const GateCounts& one) {
    return {one.gates * count,       one.register_bits * count, one.register_gates * count,
            one.multipliers * count, one.adders * count,        count > 0 ? one.depth : 0};
}

GateCounts minus(const GateCounts& a, const GateCounts& b) {
    GateCounts rest = a + times(-1, b);
    rest.depth = a.depth;
    return rest;
}

std::vector<CountedUnit> parse_gates_csv(std::string_view text) {
    const auto lines = split_at(text, '\n');
    RTU_CHECK(lines.size() >= 2 && lines[0].starts_with("# ") &&
                  lines[1] == "unit,gates,register_bits,register_gates,multipliers,adders,depth",
              "gates.csv does not begin as count_gates.sh writes it");
    std::vector<CountedUnit> units;
    std::ranges::transform(lines.begin() + 2, lines.end(), std::back_inserter(units), parse_row);
    return units;
}

std::span<const CountedUnit> counted_units() {
    static const std::vector<CountedUnit> units = parse_gates_csv(embedded_gates_csv());
    return units;
}

const GateCounts& gate_counts(std::string_view unit) {
    const auto found = std::ranges::find(counted_units(), unit, &CountedUnit::name);
    RTU_CHECK(found != counted_units().end(), "gates.csv has no row '{}'", unit);
    return found->counts;
}

std::string_view gate_counter() {
    const std::string_view text = embedded_gates_csv().substr(2);
    return text.substr(0, text.find(','));
}

}  // namespace rtu::study
