#pragma once

#include <cstdint>

#include "model/bvh.hpp"
#include "model/mailbox.hpp"
#include "model/node_format.hpp"

namespace rtu::sim {

/// How the dual-triangle unit works through a pair.
enum class PairMode : std::uint8_t {
    Single,           ///< one triangle an issue: a pair takes two
    DualIndependent,  ///< two complete testers: a pair is one issue
    DualShared,  ///< common-edge arithmetic and the unit of the exact pass shared: a pair that needs the pass
                 ///< twice, mostly a folded one, replays
};

/// What lies below the L1s.
enum class MemoryModel : std::uint8_t {
    Dram,  ///< the L2, which all RTUs share, and the DRAM
    Flat,  ///< no L2: memory of one latency and one bandwidth, as an RTL testbench has
};

/// The tree's builder and splits, and a ray's memory of the pairs it was tested with: see model/.
using model::BvhBuilder;
using model::MailboxKind;
using model::SplitKind;

/// Every hardware number of the machine. Meaning, unit, range and the default's source of each field are in
/// one table (config_keys(), sim/config_keys.cpp); the names below are its keys.
struct Config {
    std::uint32_t clock_mhz = 1000;
    std::uint32_t watchdog_cycles = 1'000'000;

    struct Host {
        std::uint32_t rays_per_cycle = 1;
    } host;

    /// The way between the host and the machine.
    struct Link {
        std::uint32_t count = 0;  ///< 0: rays and hits move for free
        std::uint32_t up_mb_per_second = 28'807;
        std::uint32_t down_mb_per_second = 28'807;
        std::uint32_t wires = 2;  ///< 1: both directions take turns
        std::uint32_t latency_ns = 425;
        std::uint32_t overhead_ns = 6000;  ///< of the host, for each transfer
        std::uint32_t outstanding = 8;     ///< transfers under way
        std::uint32_t buffers = 2;         ///< batches under way; 2: double buffering
        std::uint32_t buffer_bytes = 65'536;
        std::uint32_t batch_rays = 65'536;
    } link;

    struct Bvh {
        std::uint32_t width = 4;
        model::NodeFormat node_format = model::NodeFormat::Full;
        std::uint32_t max_leaf_pairs = 1;
        BvhBuilder builder = BvhBuilder::Sah;
        SplitKind splits = SplitKind::Object;
        std::uint32_t split_budget_percent = 20;
    } bvh;

    struct Rtu {
        std::uint32_t count = 1;
        std::uint32_t ray_slots = 128;
        std::uint32_t stack_entries = 16;
        std::uint32_t results_per_cycle = 2;  ///< unit results that the scheduler takes a cycle
        std::uint32_t fetches_per_cycle = 2;  ///< requests that it sends to the L1 a cycle

        model::MailboxOptions mailbox;  ///< of a ray

        struct Scheduler {
            std::uint32_t latency_cycles = 3;  ///< from taking a result to what follows from it
        } scheduler;

        struct Box {
            std::uint32_t boxes_per_cycle = 4;
            std::uint32_t packs_nodes = 0;  ///< 1: idle lanes of a node with few children take the next node
            std::uint32_t latency_cycles = 12;
            std::uint32_t dequantise_cycles = 5;  ///< more, for quantised nodes
        } box;

        struct Pair {
            PairMode mode = PairMode::DualShared;
            std::uint32_t testers = 1;
            std::uint32_t ii_cycles = 1;
            std::uint32_t latency_cycles = 33;
            std::uint32_t replay_cycles = 1;
            std::uint32_t hit_units = 8;  ///< behind the first pass of a tester; 0: all is in its pipeline
            std::uint32_t hit_cycles = 92;
            std::uint32_t reject_cycles = 56;
            std::uint32_t side_cycles = 111;
            std::uint32_t entries = 40;
        } pair;
    } rtu;

    struct Cache {
        std::uint32_t size_bytes = 0;
        std::uint32_t line_bytes = 128;
        std::uint32_t sector_bytes = 32;
        std::uint32_t ways = 0;
        std::uint32_t banks = 0;  ///< one line access a bank and cycle
        std::uint32_t mshrs = 0;
        std::uint32_t targets_per_mshr = 0;
        std::uint32_t latency_cycles = 0;  ///< request seen to reply sent, for a hit
    };
    Cache l1{64 * 1024, 128, 32, 16, 4, 64, 16, 20};

    struct Memory {
        MemoryModel model = MemoryModel::Dram;
        std::uint32_t latency_cycles = 100;  ///< of a flat memory, both ways together
        std::uint32_t bytes_per_cycle = 32;  ///< of a flat memory
    } memory;

    Cache l2{4 * 1024 * 1024, 128, 32, 16, 4, 128, 16, 100};

    struct Dram {
        std::uint32_t channels = 4;
        std::uint32_t banks = 16;            ///< a channel
        std::uint32_t row_bytes = 2048;      ///< a bank
        std::uint32_t queue_entries = 32;    ///< a channel
        std::uint32_t bytes_per_cycle = 16;  ///< a channel, in core cycles
        std::uint32_t t_rcd_cycles = 15;
        std::uint32_t t_rp_cycles = 15;
        std::uint32_t t_cas_cycles = 14;
        std::uint32_t latency_cycles = 60;  ///< controller and link, both ways together
    } dram;
};

/// Issue to result of a box test: of quantised nodes the planes are made first.
[[nodiscard]] constexpr std::uint32_t box_latency_cycles(const Config& config) {
    const bool is_full = config.bvh.node_format == model::NodeFormat::Full;
    return config.rtu.box.latency_cycles + (is_full ? 0 : config.rtu.box.dequantise_cycles);
}

}  // namespace rtu::sim
