#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "sim/config_keys.hpp"
#include "study/pairing/pairing_study.hpp"

namespace rtu::study {
namespace {

constexpr std::array studies = std::to_array<PairingStudyInfo>({
    {PairingStudyKind::Window, "window", "window:N with N from 2 to 64, and the methods beside it",
     "window size N (triangles)", true},
    {PairingStudyKind::Rotation, "rotation", "the scene turned from 0 to 90 degrees about its upward axis",
     "rotation (degrees)"},
    {PairingStudyKind::RayKind, "ray_kind", "each kind of ray on its own", ""},
    {PairingStudyKind::Preset, "preset", "every preset", ""},
    {PairingStudyKind::L1Size, "l1_size", "capacity of the L1, from an eighth to eight times",
     "L1 size (KiB)", true},
    {PairingStudyKind::L2Size, "l2_size", "capacity of the L2, from an eighth to sixteen times",
     "L2 size (MiB)", true},
    {PairingStudyKind::DramBandwidth, "dram_bandwidth", "DRAM bandwidth, from an eighth to eight times",
     "DRAM bandwidth (GB/s)", true},
    {PairingStudyKind::Testers, "testers", "pair testers: single, dual_independent, dual_shared", ""},
});

// The machine with one number changed; nothing when its other numbers do not allow that.
std::optional<sim::Config> changed(const sim::EffectiveConfig& machine, std::string_view key,
                                   std::int64_t value) {
    try {
        const sim::EffectiveConfig result =
            assign(machine, {std::string(key), value, "varied by the study", "study"});
        validate(result);
        return result.config;
    } catch (const Error&) {
        return std::nullopt;
    }
}

// The value times 2^first .. 2^last, whole numbers of at least 1, none twice.
std::vector<std::int64_t> doublings(std::uint32_t value, int first, int last) {
    std::vector<std::int64_t> values;
    for (int power = first; power <= last; ++power) {
        const auto scaled = std::max<std::int64_t>(1, std::llround(std::ldexp(double(value), power)));
        if (values.empty() || values.back() != scaled) values.push_back(scaled);
    }
    return values;
}

using Points = std::vector<StudyPoint>;

Points window_points(const PairingSetting& base, const PairingOptions& options) {
    Points points;
    for (std::uint32_t window = 2; window <= 64; window *= 2) {
        const model::PairingMethod method{model::PairingKind::Window, window};
        points.push_back({fmt::format("{}", window), double(window), base, method});
    }
    for (const model::PairingMethod& method : options.methods) {
        if (method.kind != model::PairingKind::Window) points.push_back({"-", std::nullopt, base, method});
    }
    return points;
}

Points rotation_points(const PairingSetting& base, const model::Camera& camera) {
    std::size_t up = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
        if (std::abs(camera.up[axis]) > std::abs(camera.up[up])) up = axis;
    }
    Points points;
    for (int degrees = 0; degrees <= 90; degrees += 15) {
        PairingSetting setting = base;
        setting.rotation[up] += degrees;
        points.push_back({fmt::format("{} deg", degrees), double(degrees), setting, {}});
    }
    return points;
}

Points ray_kind_points(const PairingSetting& base) {
    using enum model::WorkloadKind;
    Points points;
    for (const model::WorkloadKind kind : {Primary, Shadow, AmbientOcclusion, Diffuse, Random}) {
        const PairingSetting setting{base.config, base.rotation, {kind}};
        points.push_back({std::string(to_string(kind)), std::nullopt, setting, {}});
    }
    return points;
}

Points preset_points(const PairingSetting& base, const PairingOptions& options) {
    Points points;
    for (const auto& [name, machine] : options.presets) {
        PairingSetting setting = base;
        setting.config = machine.config;
        points.push_back({name, std::nullopt, setting, {}});
    }
    return points;
}

struct SizeUnit {
    std::string_view name;
    double bytes;
};

Points size_points(const PairingSetting& base, const PairingOptions& options, std::string_view key,
                   std::span<const std::int64_t> sizes, SizeUnit unit) {
    Points points;
    for (const std::int64_t bytes : sizes) {
        const auto config = changed(options.machine, key, bytes);
        if (!config) continue;
        PairingSetting setting = base;
        setting.config = *config;
        const double size = double(bytes) / unit.bytes;
        points.push_back({fmt::format("{:g} {}", size, unit.name), size, setting, {}});
    }
    return points;
}

Points bandwidth_points(const PairingSetting& base, const PairingOptions& options) {
    Points points;
    const sim::Config& config = options.machine.config;
    for (const std::int64_t bytes : doublings(config.dram.bytes_per_cycle, -3, 3)) {
        const auto machine = changed(options.machine, "dram.bytes_per_cycle", bytes);
        if (!machine) continue;
        PairingSetting setting = base;
        setting.config = *machine;
        const double gigabytes = double(bytes) * config.dram.channels * config.clock_mhz / 1000;
        points.push_back({fmt::format("{:.1f} GB/s", gigabytes), gigabytes, setting, {}});
    }
    return points;
}

// A study of what a flat memory does not have would print the same row many times.
void require_dram(PairingStudyKind kind, const sim::Config& config) {
    if (config.memory.model == sim::MemoryModel::Dram) return;
    throw Error("--study {}: expected memory.model = dram, got flat", info(kind).name);
}

Points tester_points(const PairingSetting& base) {
    Points points;
    for (const sim::PairMode mode :
         {sim::PairMode::Single, sim::PairMode::DualIndependent, sim::PairMode::DualShared}) {
        PairingSetting setting = base;
        setting.config.rtu.pair.mode = mode;
        points.push_back({std::string(sim::pair_mode_names()[std::size_t(mode)]), std::nullopt, setting, {}});
    }
    return points;
}

}  // namespace

std::span<const PairingStudyInfo> pairing_studies() { return studies; }

const PairingStudyInfo& info(PairingStudyKind kind) { return studies.at(std::size_t(kind)); }

PairingStudyKind parse_pairing_study(std::string_view name) {
    std::string known;
    for (const PairingStudyInfo& study : studies) {
        if (study.name == name) return study.kind;
        known += fmt::format("{}, ", study.name);
    }
    throw Error("--study: expected {}or all, got '{}'", known, model::one_line(name));
}

std::vector<StudyPoint> study_points(PairingStudyKind kind, const PairingOptions& options,
                                     const model::Camera& camera) {
    const sim::Config& config = options.machine.config;
    const PairingSetting base{config, options.rotation, options.workloads};
    switch (kind) {
        case PairingStudyKind::Window:
            return window_points(base, options);
        case PairingStudyKind::Rotation:
            return rotation_points(base, camera);
        case PairingStudyKind::RayKind:
            return ray_kind_points(base);
        case PairingStudyKind::Preset:
            return preset_points(base, options);
        case PairingStudyKind::L1Size:
            return size_points(base, options, "l1.size_bytes", doublings(config.l1.size_bytes, -3, 3),
                               {"KiB", 1024});
        case PairingStudyKind::L2Size:
            require_dram(kind, config);
            return size_points(base, options, "l2.size_bytes", doublings(config.l2.size_bytes, -3, 4),
                               {"MiB", 1024 * 1024});
        case PairingStudyKind::DramBandwidth:
            require_dram(kind, config);
            return bandwidth_points(base, options);
        case PairingStudyKind::Testers:
            return tester_points(base);
    }
    fail_check(__FILE__, __LINE__, "unknown pairing study");
}

}  // namespace rtu::study
