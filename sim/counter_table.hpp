#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rtu::sim {

/// One counter of a unit. `Counters` is a plain struct that holds nothing but uint64_t fields.
template <class Counters>
struct CounterRow {
    std::string_view name;  ///< equals the field's name
    std::string_view unit;
    std::string_view meaning;
    std::uint64_t Counters::*member;
};

/// Whether every field of `Counters` has exactly one row; for a static_assert next to the table.
template <class Counters, std::size_t N>
[[nodiscard]] constexpr bool has_row_for_every_field(const std::array<CounterRow<Counters>, N>& rows) {
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (rows[i].member == rows[j].member || rows[i].name == rows[j].name) return false;
        }
    }
    return sizeof(Counters) == N * sizeof(std::uint64_t);
}

/// The counters of two units together, field by field.
template <class Counters, std::size_t N>
[[nodiscard]] constexpr Counters sum(const Counters& a, const Counters& b,
                                     const std::array<CounterRow<Counters>, N>& rows) {
    Counters result = a;
    for (const CounterRow<Counters>& row : rows) result.*row.member += b.*row.member;
    return result;
}

}  // namespace rtu::sim
