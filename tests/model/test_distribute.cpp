#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "model/distribute.hpp"
#include "tests/model/pairing_meshes.hpp"

namespace rtu::test {
namespace {

using namespace rtu::model;

struct Item {
    std::uint32_t bucket, number;
    friend bool operator==(const Item&, const Item&) = default;
};

std::vector<Item> random_items(std::uint32_t count, std::uint32_t bucket_count) {
    std::mt19937 random(count);
    std::vector<Item> items;
    for (std::uint32_t i = 0; i < count; ++i) items.push_back({below(random, bucket_count), i});
    return items;
}

std::vector<Item> stable_sorted(std::vector<Item> items) {
    std::ranges::stable_sort(items, {}, &Item::bucket);
    return items;
}

TEST(Distribute, IsAStableSortByBucket) {
    for (const std::uint32_t count : {0U, 1U, 10U, 11U, 5000U}) {
        const std::vector<Item> items = random_items(count, 7);
        std::vector<Item> out(count);
        const auto begins = distribute(Blocks{count, 10}, 7, std::span(out),
                                       [&](std::size_t begin, std::size_t end, const auto& visit) {
                                           for (std::size_t i = begin; i < end; ++i)
                                               visit(items[i].bucket, items[i]);
                                       });
        EXPECT_EQ(out, stable_sorted(items));
        ASSERT_EQ(begins.size(), 8U);
        for (std::uint32_t bucket = 0; bucket < 8; ++bucket) {
            const auto is_before = [=](const Item& item) { return item.bucket < bucket; };
            EXPECT_EQ(begins[bucket], std::ranges::count_if(items, is_before));
        }
    }
}

TEST(Distribute, TakesThreeItemsAtATime) {
    // Into three buckets, so that all ways for the three to fall together occur.
    constexpr std::uint32_t triples = 1000;
    const std::vector<Item> items = random_items(3 * triples, 3);
    std::vector<Item> out(items.size());
    const auto begins = distribute(
        Blocks{triples, 10}, 3, std::span(out), [&](std::size_t begin, std::size_t end, const auto& visit) {
            for (std::size_t i = begin; i < end; ++i) {
                const std::array three{items[3 * i], items[3 * i + 1], items[3 * i + 2]};
                visit(std::array{three[0].bucket, three[1].bucket, three[2].bucket}, three);
            }
        });
    EXPECT_EQ(out, stable_sorted(items));
    EXPECT_EQ(begins.back(), items.size());
}

}  // namespace
}  // namespace rtu::test
