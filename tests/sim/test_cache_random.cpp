#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cache_rig.hpp"

namespace rtu::test {
namespace {

using sim::ClockMode;

// Random traffic: reads of one to three lines and writes, over a range that does not
// fit.
std::uint32_t next_random(std::uint32_t& state) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

MemoryRequest random_request(std::uint32_t& state, std::uint32_t tag, std::uint8_t source) {
    const std::uint64_t address = next_random(state) % 96 * std::uint64_t{32};
    if (next_random(state) % 4 == 0) return write(address, 32);
    return read(address, 32 * (1 + next_random(state) % 8), tag, source);
}

CacheSetup random_traffic(std::uint32_t seed, Cycle spacing_cycles) {
    CacheSetup setup{.config = small_cache(), .scripts = {{}, {}}, .reply_count = 2, .channel_depth = 4};
    std::uint32_t state = seed;
    for (std::uint8_t input = 0; input < 2; ++input) {
        Cycle when = 0;
        for (std::uint32_t i = 0; i < 2000; ++i) {
            if (next_random(state) % 8 == 0) when += next_random(state) % 100;
            when += spacing_cycles;
            setup.scripts[input].push_back({when, random_request(state, i, input)});
        }
    }
    return setup;
}

TEST(Cache, AnswersEveryReadExactlyOnce) {
    CacheSetup setup = random_traffic(1, 0);
    setup.config.mshrs = 2;
    setup.config.targets_per_mshr = 2;
    setup.is_sink_open = [](Cycle now) { return now % 5 != 0; };
    const CacheOutcome outcome = run(setup);
    for (std::size_t input = 0; input < 2; ++input) {
        std::vector<Stamped<MemoryReply>> replies = outcome.received[input];
        std::ranges::sort(replies, {}, [](const auto& reply) { return reply.item.tag; });
        std::vector<MemoryReply> expected;
        for (const auto& request : setup.scripts[input]) {
            if (!request.item.is_write) expected.push_back({request.item.address, request.item.tag});
        }
        ASSERT_EQ(replies.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(replies[i].item, expected[i]);
    }
    // The traffic reached the corners that it is meant to reach.
    EXPECT_GT(outcome.counters.mshr_full_cycles, 0U);
    EXPECT_GT(outcome.counters.target_full_cycles, 0U);
    EXPECT_GT(outcome.counters.mshr_merges, 0U);
    EXPECT_GT(outcome.counters.write_backs, 0U);
}

TEST(Cache, DoesNotDependOnTheOrderOfUnitsOrTheClockMode) {
    for (const std::uint32_t seed : {2U, 3U}) {
        CacheSetup setup = random_traffic(seed, seed == 2 ? 0 : 20);
        const CacheOutcome forward = run(setup);
        setup.is_reversed = true;
        EXPECT_EQ(run(setup), forward);
        setup.mode = ClockMode::Verify;
        EXPECT_EQ(run(setup), forward);
        EXPECT_EQ(forward.account.total(), forward.cycles);
    }
}

// What a cache does to one access after the other, without time.
class FunctionalCache {
  public:
    explicit FunctionalCache(const sim::Config::Cache& config)
        : config_(config), sets_(config.size_bytes / config.line_bytes / config.ways) {}

    struct Counts {
        std::uint64_t hits = 0, misses = 0, evictions = 0, write_backs = 0;
        friend bool operator==(const Counts&, const Counts&) = default;
    };
    void access(const MemoryRequest& request) {
        const std::uint64_t first = request.address / config_.sector_bytes;
        const std::uint64_t last = (request.address + request.size_bytes - 1) / config_.sector_bytes;
        const std::uint64_t sectors_per_line = config_.line_bytes / config_.sector_bytes;
        for (std::uint64_t line = first / sectors_per_line; line <= last / sectors_per_line; ++line) {
            std::vector<std::uint64_t> sectors;
            for (std::uint64_t s = std::max(first, line * sectors_per_line);
                 s <= std::min(last, (line + 1) * sectors_per_line - 1); ++s) {
                sectors.push_back(s);
            }
            access_line(line, sectors, request.is_write);
        }
    }
    [[nodiscard]] const Counts& counts() const { return counts_; }

  private:
    struct Line {
        std::uint64_t number;
        std::vector<std::uint64_t> sectors;
        bool is_dirty = false;
    };
    void access_line(std::uint64_t number, const std::vector<std::uint64_t>& sectors, bool is_write) {
        std::vector<Line>& set = sets_[number % sets_.size()];  // most recently used first
        const auto found = std::ranges::find(set, number, &Line::number);
        if (found != set.end()) {
            std::rotate(set.begin(), found, found + 1);
        } else {
            if (set.size() == config_.ways) {
                ++counts_.evictions;
                if (set.back().is_dirty) ++counts_.write_backs;
                set.pop_back();
            }
            set.insert(set.begin(), Line{number, {}});
        }
        Line& line = set.front();
        bool is_hit = true;
        for (const std::uint64_t sector : sectors) {
            if (std::ranges::find(line.sectors, sector) != line.sectors.end()) continue;
            is_hit = false;
            line.sectors.push_back(sector);
        }
        line.is_dirty |= is_write;
        if (!is_write) ++(is_hit ? counts_.hits : counts_.misses);
    }

    sim::Config::Cache config_;
    std::vector<std::vector<Line>> sets_;
    Counts counts_;
};

TEST(Cache, CountsWhatAFunctionalCacheCountsWithOneRequestInFlight) {
    CacheSetup setup = random_traffic(4, 200);
    setup.scripts.pop_back();
    FunctionalCache expected(setup.config);
    for (const auto& request : setup.scripts[0]) expected.access(request.item);
    const sim::CacheCounters counters = run(setup).counters;
    const FunctionalCache::Counts counts{counters.hits, counters.misses, counters.evictions,
                                         counters.write_backs};
    EXPECT_EQ(counts, expected.counts());
    EXPECT_GT(counts.hits, 100U);
    EXPECT_GT(counts.write_backs, 100U);
}

}  // namespace
}  // namespace rtu::test
