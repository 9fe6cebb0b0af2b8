#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "sim/config.hpp"
#include "sim/cycle.hpp"
#include "sim/memory_counters.hpp"
#include "sim/memory_message.hpp"

namespace rtu::test {

using sim::Cycle;

inline constexpr std::uint32_t sector_bytes = 32;
inline constexpr std::uint32_t cache_tags = 128;  // of the Verilated cache
inline constexpr std::uint8_t source_count = 3;
using Sector = std::array<std::byte, sector_bytes>;

/// A request that a client will make, `gap_cycles` after the one before it or as soon after as it can.
struct PlannedRequest {
    std::uint32_t gap_cycles = 0;
    std::uint64_t address = 0;
    std::uint32_t size_bytes = sector_bytes;
    std::uint8_t source = 0;
    bool is_write = false;
};

/// What a cache and the memory behind it are asked to do.
struct CacheCase {
    sim::Config::Cache cache{64 * 1024, 128, 32, 16, 4, 64, 16, 20};
    sim::Config::Memory memory{.model = sim::MemoryModel::Flat};
    std::vector<PlannedRequest> plan{};
    std::function<bool(std::uint8_t source, Cycle now)> takes{};  ///< whether a client takes replies; always
};

/// What passed between client and cache in a cycle.
struct CacheEvent {
    enum class Kind : std::uint8_t { Request, Reply };
    Cycle cycle = 0;
    Kind kind = Kind::Request;
    std::uint8_t source = 0;
    std::uint32_t tag = 0;
    friend bool operator==(const CacheEvent&, const CacheEvent&) = default;
};

struct CacheRun {
    std::vector<CacheEvent> events;
    sim::CacheCounters counters;
    sim::FlatMemoryCounters memory;  ///< stalls are not compared
    Cycle cycles = 0;
};

/// A client of a cache, the same for a simulated and a Verilated one: up to two requests a cycle, one reply a
/// cycle and source, one read a tag at a time. It knows what every read must bring, and does not write what
/// a read that is under way asks for.
class CacheClient {
  public:
    explicit CacheClient(const CacheCase& test_case);

    struct Request {
        sim::MemoryRequest message;
        Sector data{};  ///< of a write
    };
    /// The request that is to be made in this cycle; null when there is none. It stays until pushed().
    [[nodiscard]] const Request* next(Cycle now);
    void pushed(Cycle now);
    [[nodiscard]] bool takes(std::uint8_t source, Cycle now) const;
    /// Takes a reply. The bytes are checked where they are given; a simulated cache has none.
    void reply(Cycle now, std::uint8_t source, std::uint32_t tag, const std::byte* data = nullptr);
    [[nodiscard]] bool is_done() const { return planned_ == case_.plan.size() && under_way_.empty(); }

    [[nodiscard]] const std::vector<CacheEvent>& events() const { return events_; }
    /// All of memory at the start.
    [[nodiscard]] const std::vector<std::byte>& initial_memory() const { return initial_; }
    /// All of memory as reads see it after every request that was made.
    [[nodiscard]] const std::vector<std::byte>& memory() const { return memory_; }

  private:
    struct Read {
        std::uint64_t first_sector = 0;
        std::uint8_t source = 0;
        std::vector<std::byte> expected;
    };
    void prepare(const PlannedRequest& planned);
    [[nodiscard]] bool is_being_read(std::uint64_t sector) const { return readers_.contains(sector); }

    CacheCase case_;
    std::size_t planned_ = 0;
    bool is_prepared_ = false;
    Cycle earliest_ = 0;
    Request request_;
    std::set<std::uint32_t> free_tags_;
    std::map<std::uint32_t, Read> under_way_;  // by tag
    std::multiset<std::uint64_t> readers_;     // sectors
    std::vector<std::byte> initial_, memory_;
    std::vector<CacheEvent> events_;
};

/// Cycles that a run goes on after the last reply, for what is posted to reach memory.
[[nodiscard]] Cycle drain_cycles(const CacheCase& test_case);

/// sim::Cache with sim::FlatMemory.
[[nodiscard]] CacheRun run_simulated(const CacheCase& test_case);
/// The Verilated cache with rtl::FlatMemory. Checks every byte that is read, and those in memory at the end
/// that no line of the cache may hold.
[[nodiscard]] CacheRun run_verilated(const CacheCase& test_case);

}  // namespace rtu::test
