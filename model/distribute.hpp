#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "model/blocks.hpp"

namespace rtu::model {

/// Counts the items of each bucket.
template <class Item>
struct CountItems {
    std::uint32_t* counts;

    void operator()(std::uint32_t bucket, const Item&) const { ++counts[bucket]; }
    void operator()(const std::array<std::uint32_t, 3>& buckets, const std::array<Item, 3>&) const {
        for (const std::uint32_t bucket : buckets) ++counts[bucket];
    }
};

/// Writes each item to the next place of its bucket.
template <class Item>
struct PlaceItems {
    std::uint32_t* places;
    Item* out;

    void operator()(std::uint32_t bucket, const Item& item) const { out[places[bucket]++] = item; }
    /// The three places are read before any is written: where neighbours go to the same bucket, as in a mesh
    /// in a sensible order, one after the other would wait for the last write of the place each time.
    void operator()(const std::array<std::uint32_t, 3>& buckets, const std::array<Item, 3>& items) const {
        const std::uint32_t place_a = places[buckets[0]];
        const std::uint32_t place_b = places[buckets[1]] + std::uint32_t(buckets[1] == buckets[0]);
        const std::uint32_t place_c = places[buckets[2]] + std::uint32_t(buckets[2] == buckets[0]) +
                                      std::uint32_t(buckets[2] == buckets[1]);
        places[buckets[0]] = place_a + 1;
        places[buckets[1]] = place_b + 1;
        places[buckets[2]] = place_c + 1;
        out[place_a] = items[0];
        out[place_b] = items[1];
        out[place_c] = items[2];
    }
};

/// One pass of a counting sort: puts every item of the source into its bucket in `out`, stable, and returns
/// where the buckets begin: [bucket_count + 1], the last is the number of items. `generate(begin, end,
/// visit)` calls visit(bucket, item) for every item of [begin, end) of the source; it is called twice for
/// each block.
template <class Item, class Generate>
[[nodiscard]] std::vector<std::uint32_t> distribute(Blocks source, std::uint32_t bucket_count,
                                                    std::span<Item> out, const Generate& generate) {
    // Of each block and bucket: first the count, then where the next item goes.
    std::vector<std::uint32_t> places(source.count() * bucket_count);
    source.for_each([&](std::size_t block, std::size_t begin, std::size_t end) {
        std::uint32_t* const counts = places.data() + block * bucket_count;
        generate(begin, end, CountItems<Item>{counts});
    });
    std::vector<std::uint32_t> begins(bucket_count + 1);
    std::uint32_t next = 0;
    for (std::uint32_t bucket = 0; bucket < bucket_count; ++bucket) {
        begins[bucket] = next;
        for (std::size_t i = bucket; i < places.size(); i += bucket_count)
            next += std::exchange(places[i], next);
    }
    begins[bucket_count] = next;
    source.for_each([&](std::size_t block, std::size_t begin, std::size_t end) {
        std::uint32_t* const place = places.data() + block * bucket_count;
        generate(begin, end, PlaceItems<Item>{place, out.data()});
    });
    return begins;
}

}  // namespace rtu::model
