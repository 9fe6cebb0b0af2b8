#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "model/traversal.hpp"

namespace rtu::rtl {

/// What a pair tester shares; as rtu.pair.mode of the simulator, in its order.
enum class TesterMode : std::uint8_t { Single, DualIndependent, DualShared };

/// A configuration of the RTU in SystemVerilog and of the memory behind it. Width, mode and hit units are
/// fixed when it is Verilated, and so is whether it has a mailbox: see has_build(). All else is chosen when
/// it runs, up to the maxima of rtl_ref/rtu/rtu.sv.
struct RtlConfig {
    std::uint32_t width = 4;  ///< children of a node, and box tests a cycle
    TesterMode mode = TesterMode::DualShared;
    std::uint32_t hit_units = 8;
    std::uint32_t slots = 128;         ///< 1 to 128
    std::uint32_t stack_entries = 16;  ///< 1 to 16
    std::uint32_t mailbox_entries =
        0;  ///< of a ray, the pairs tested last; 0 to 16, width 4 and DualShared only, else 0

    /// The L1: lines of 128 bytes in sectors of 32.
    struct Cache {
        std::uint32_t sets = 32;              ///< a power of two, `banks` to 32
        std::uint32_t ways = 16;              ///< 1 to 16
        std::uint32_t banks = 4;              ///< 1, 2 or 4
        std::uint32_t mshrs = 64;             ///< 1 to 64
        std::uint32_t targets_per_mshr = 16;  ///< 1 to 16
        std::uint32_t latency_cycles = 20;    ///< 1 to 32
    };
    Cache cache{};

    /// The memory: in order, one request on the bus at a time.
    struct Memory {
        std::uint32_t latency_cycles = 100;
        std::uint32_t bytes_per_cycle = 32;
    };
    Memory memory{};
};

/// What a run gives and took.
struct RtlResult {
    std::vector<std::optional<model::Hit>> hits;  ///< in the order of the rays
    std::uint64_t cycles = 0;  ///< from the first ray accepted to the last hit returned, both cycles included
    model::TraversalCounts counts;  ///< but duplicate_tests, which it cannot tell
    std::uint64_t mailbox_lookups = 0;
    std::uint64_t spilled_entries = 0;  ///< of stacks, written to memory
    std::uint64_t reloaded_entries = 0;
    std::uint64_t cache_hits = 0;  ///< line reads
    std::uint64_t cache_misses = 0;
    std::uint64_t cache_merges = 0;  ///< line reads that found their line on its way
};

/// Cycles of which signals are recorded, in a file whose name ends in .vcd or .fst. Time is counted in half
/// cycles from the first one after reset: cycle c has settled at 2 c, and its clock rises at 2 c + 1.
struct Waves {
    std::filesystem::path file;
    std::uint64_t first_cycle = 0;
    std::uint64_t end_cycle = 0;  ///< the first that is not recorded
};

/// Two sides of the RTU that are unwilling at random, and what its registers hold before reset: for tests.
struct Disturbance {
    std::uint64_t seed = 0;
    bool hesitates =
        false;  ///< hits and memory requests are not always taken, rays and fills not always offered
};

/// Whether an RTU of this width, mode and number of hit units, with so large a mailbox, was Verilated.
[[nodiscard]] bool has_build(const RtlConfig& config);

/// Runs rays through the RTU. The image has one pair a leaf. Only the RTU of the default RtlConfig's width
/// and mode records waves. Throws rtu::Error when the RTU cannot take the image or the configuration, or
/// waves cannot be recorded; std::logic_error when it comes to no end or breaks a rule.
[[nodiscard]] RtlResult run_rtl(const model::MemoryImage& image, std::span<const model::Ray> rays,
                                model::RayKind kind, const RtlConfig& config, const Waves* waves = nullptr,
                                const Disturbance* disturbance = nullptr);

}  // namespace rtu::rtl
