#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace rtu::model {

/// Sorts `items` by `key(item)`, a uint32, ascending and stable. `scratch` is as long as `items`; its
/// contents are lost. Least significant digit first, four passes of 8 bits: 256 write streams stay in the
/// first-level cache, and after an even number of passes the result is back in `items`.
template <class Item, class Key>
void radix_sort(std::span<Item> items, std::span<Item> scratch, Key key) {
    constexpr std::uint32_t digits = 4, digit_bits = 8, radix = 1U << digit_bits;
    const auto digit_of = [&key](const Item& item, std::uint32_t digit) {
        return (key(item) >> (digit * digit_bits)) & (radix - 1);
    };
    std::array<std::array<std::size_t, radix>, digits>
        place{};  // first counts, then where the next item goes
    for (const Item& item : items) {
        for (std::uint32_t digit = 0; digit < digits; ++digit) ++place[digit][digit_of(item, digit)];
    }
    for (std::uint32_t digit = 0; digit < digits; ++digit) {
        std::size_t next = 0;
        for (std::size_t& p : place[digit]) next += std::exchange(p, next);
        for (const Item& item : items) scratch[place[digit][digit_of(item, digit)]++] = item;
        std::swap(items, scratch);
    }
}

}  // namespace rtu::model
