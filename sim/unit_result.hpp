#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/counter_table.hpp"
#include "sim/cycle_account.hpp"

namespace rtu::sim {

/// One counter's value, with its unit of measure.
struct CounterValue {
    std::string_view name;
    std::string_view unit;
    std::uint64_t value = 0;
};

/// Where one unit's cycles went and what it counted. With several RTUs the names start with "rtuN.".
struct UnitResult {
    std::string name;
    CycleAccount cycles;
    std::vector<CounterValue> counters;
};

/// Every counter of a unit, in the order of its table.
template <class Counters, std::size_t N>
[[nodiscard]] std::vector<CounterValue> counter_values(const std::array<CounterRow<Counters>, N>& rows,
                                                       const Counters& counters) {
    std::vector<CounterValue> result;
    result.reserve(N);
    for (const auto& row : rows) result.push_back({row.name, row.unit, counters.*row.member});
    return result;
}

}  // namespace rtu::sim
