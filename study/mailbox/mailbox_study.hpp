#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/mailbox.hpp"
#include "model/pairing.hpp"
#include "model/workload.hpp"
#include "sim/config.hpp"
#include "study/run_options.hpp"

// What spatial splits do to a machine that tests pairs, and what a mailbox saves of what they cost.

namespace rtu::study {

/// What `rtusim mailbox` is asked. Everything is validated by whoever fills this in.
struct MailboxStudyOptions {
    sim::Config config;  ///< its bvh.splits and rtu.mailbox are what is varied
    std::vector<SceneSource> scenes;
    std::vector<model::PairingMethod> pairings;
    std::vector<std::uint32_t> entries;  ///< of mailboxes of the last pairs, ascending, 1..16
    std::vector<model::WorkloadKind> workloads;
    model::Resolution resolution;
    std::optional<std::filesystem::path> camera_file;  ///< as in RunOptions
    std::uint64_t seed = 1;
    /// Told of each scene's phases; may be empty.
    std::function<void(std::string_view scene, std::string_view phase)> progress;
};

/// One workload on one tree with one mailbox: raw counts, and what is computed from them.
struct MailboxRow {
    std::string scene;
    std::string workload;
    std::string pairing;
    sim::SplitKind splits = sim::SplitKind::Object;
    model::MailboxOptions mailbox;
    double extra_leaf_percent = 0;  ///< leaves that the splits added, of the pairs
    std::uint64_t image_bytes = 0;
    std::uint64_t rays = 0;
    std::uint64_t cycles = 0;
    std::uint64_t box_tests = 0;
    std::uint64_t pair_tests = 0;
    std::uint64_t duplicate_tests = 0;  ///< of the pair tests
    std::uint64_t lookups = 0;
    std::uint64_t mailbox_hits = 0;    ///< pair tests that were saved
    std::uint64_t bytes_saved = 0;     ///< of leaves, at the L1
    std::uint64_t bytes_moved = 0;     ///< read and written by a mailbox in memory, at the L1
    std::uint64_t all_hits = 0;        ///< triangles that a sample of the rays pierces, if no hit ended a ray
    std::uint64_t reported_twice = 0;  ///< more reports than that, where duplicates are allowed
    double mrps = 0;
    double gates = 0;      ///< of all RTUs
    double sram_bits = 0;  ///< likewise
};

/// "none", "recent 8", "hashed 8" or "per_pair".
[[nodiscard]] std::string mailbox_name(const model::MailboxOptions& mailbox);

struct MailboxReport {
    std::string version;
    std::uint64_t seed = 0;
    std::uint32_t clock_mhz = 0;
    std::uint32_t split_budget_percent = 0;
    /// By scene, pairing, splits, workload, mailbox.
    std::vector<MailboxRow> rows;
};

/// Simulates the same rays on trees with and without spatial splits over each pairing, with each mailbox.
/// Throws as run_scene() does, and std::logic_error when a hit depends on any of it.
[[nodiscard]] MailboxReport run_mailbox_study(const MailboxStudyOptions& options);

}  // namespace rtu::study
