#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "traces/bytes.hpp"

// Columns: one member of all items of a chunk side by side, as byte planes (all lowest bytes, then all second
// bytes, ...). Signs and exponents vary little between neighbours, so zstd finds more in planes than in whole
// numbers.

namespace rtu::traces {

/// Appends a column of 4-byte values: value_of(item) for each item.
template <class Items, class ValueOf>
void append_column(std::string& bytes, const Items& items, ValueOf value_of) {
    const std::size_t begin = bytes.size(), count = items.size();
    bytes.resize(begin + 4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto word = std::bit_cast<std::uint32_t>(value_of(items[i]));
        for (std::size_t plane = 0; plane < 4; ++plane) {
            bytes[begin + plane * count + i] = char(word >> (8 * plane) & 0xffU);
        }
    }
}

/// Takes a column [count] of 4-byte values; throws Error when there are too few bytes.
template <class Value>
[[nodiscard]] std::vector<Value> take_column(ByteReader& bytes, std::size_t count) {
    static_assert(sizeof(Value) == 4);
    const std::string_view planes = bytes.take(4 * count);
    std::vector<Value> values;
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t word = 0;
        for (std::size_t plane = 0; plane < 4; ++plane) {
            word |= std::uint32_t(static_cast<unsigned char>(planes[plane * count + i])) << (8 * plane);
        }
        values.push_back(std::bit_cast<Value>(word));
    }
    return values;
}

}  // namespace rtu::traces
