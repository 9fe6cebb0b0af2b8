#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/camera.hpp"
#include "sim/config.hpp"
#include "sim/cycle_account.hpp"
#include "study/chart/pixel_data.hpp"

namespace rtu::study {

/// What the scene's file holds.
struct SceneFacts {
    std::string name;
    std::uint64_t triangle_count = 0;
    std::uint64_t vertex_count = 0;
    std::uint64_t degenerate_count = 0;
};

/// What the pairing found. `seconds` is host time.
struct PairingFacts {
    std::string method;
    std::string edge_identity;
    double paired_percent = 0;
    std::uint64_t pair_count = 0;
    std::uint64_t single_count = 0;
    double seconds = 0;
};

/// The tree in the machine's memory. `build_seconds` is host time.
struct BvhFacts {
    std::uint32_t width = 0;
    std::uint64_t node_count = 0;
    std::uint64_t leaf_count = 0;
    std::uint64_t image_bytes = 0;
    double build_seconds = 0;
    std::uint64_t extra_leaf_count = 0;  ///< of the leaves, those that spatial splits added
};

/// One key of the effective configuration, named as `--set` names it.
struct ConfigEntry {
    std::string key;
    std::variant<std::uint64_t, std::string> value;
};

/// Every key of the configuration with its value, in the order of sim::config_keys().
[[nodiscard]] std::vector<ConfigEntry> config_entries(const sim::Config& config);

/// One raw count of a unit; `unit` is its unit of measure ("requests", "bytes", ...).
struct CounterValue {
    std::string name;
    std::string unit;
    std::uint64_t value = 0;
};

/// Where one unit's cycles went, and what it counted.
struct UnitReport {
    std::string name;
    sim::CycleAccount cycles;
    std::vector<CounterValue> counters;
};

/// One workload's simulation: raw counts only, ratios are computed by the writers.
struct WorkloadReport {
    std::string name;
    std::uint64_t ray_count = 0;
    std::uint64_t hit_count = 0;
    std::uint64_t box_tests = 0;
    std::uint64_t node_visits = 0;
    std::uint64_t pair_tests = 0;
    std::uint64_t triangle_tests = 0;
    std::uint64_t cycles = 0;
    std::vector<UnitReport> units;   ///< ray source, RTUs, hit sink
    std::vector<UnitReport> memory;  ///< caches and DRAM, from the RTUs outwards
};

/// What `--check` found, over all workloads.
struct CheckReport {
    std::uint64_t compared = 0;           ///< simulated hits compared with the reference traversal
    std::uint64_t mismatches = 0;         ///< of those, not bit-equal
    std::uint64_t embree_compared = 0;    ///< rays also traced by Embree
    std::uint64_t embree_mismatches = 0;  ///< differences in which the exact test finds Embree right alone
    std::uint64_t embree_wrong = 0;       ///< differences in which the exact test finds Embree wrong
    std::uint64_t both_wrong = 0;  ///< of those, in which the simulated hit is not the exact one either
    std::uint64_t ties = 0;        ///< another triangle, and the exact test allows both
    [[nodiscard]] bool is_clean() const { return mismatches == 0 && embree_mismatches == 0; }
};

/// What the run cost the host; differs from run to run.
struct HostFacts {
    double cpu_seconds = 0;        ///< CPU time inside the cycle simulation, all workloads
    double total_cpu_seconds = 0;  ///< CPU time of the whole scene, from its file to its last hit
    std::uint64_t simulated_rays = 0;
    std::uint64_t peak_rss_bytes = 0;  ///< of the process since its start: the scenes before count too
};

/// Everything that one scene's run reports. Deterministic outside `host`, `pairing.seconds` and
/// `bvh.build_seconds`.
struct SceneReport {
    std::string version;     ///< of rtusim
    std::string input_hash;  ///< fingerprint() of the mesh, 16 hex digits
    std::string preset;
    std::uint64_t seed = 0;
    model::Resolution resolution;  ///< 0 x 0: rays of a file that says nothing of a picture
    model::Camera camera;
    std::string
        camera_source;  ///< "automatic", "built-in", or the camera file's name; "none": rays of a file
    std::optional<std::string> rays_file;  ///< name of the file that the rays were read from
    SceneFacts scene;
    PairingFacts pairing;
    BvhFacts bvh;
    std::uint32_t clock_mhz = 0;
    std::vector<ConfigEntry> config;
    std::vector<WorkloadReport> workloads;
    std::optional<CheckReport> check;  ///< only when asked for
    HostFacts host;
    std::optional<PixelData> pixels;  ///< only when asked for; no part of the text, JSON or CSV
};

/// Million rays per second at the modelled clock: rays / cycles * MHz; 0 for no cycles.
[[nodiscard]] inline double mrps(std::uint64_t ray_count, std::uint64_t cycles, std::uint32_t clock_mhz) {
    return cycles == 0 ? 0.0 : double(ray_count) / double(cycles) * double(clock_mhz);
}

/// All workloads of a scene added up (raw counts; units and memory stay empty). The name is "total".
[[nodiscard]] WorkloadReport total(const SceneReport& report);

/// fingerprint() of the configuration's keys and values.
[[nodiscard]] std::string config_hash(const SceneReport& report);

/// Simulated rays per second of host CPU time inside the cycle simulation; 0 when no time passed.
[[nodiscard]] inline double simulated_rays_per_second(const HostFacts& host) {
    return host.cpu_seconds > 0 ? double(host.simulated_rays) / host.cpu_seconds : 0.0;
}

}  // namespace rtu::study
