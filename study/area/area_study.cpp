#include "study/area/area_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/error.hpp"
#include "sim/machine.hpp"
#include "study/area/area_objective.hpp"
#include "study/scene_steps.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

using sim::PairMode;

constexpr std::array modes{PairMode::Single, PairMode::DualIndependent, PairMode::DualShared};

sim::Config with_mode(sim::Config config, PairMode mode) {
    config.rtu.pair.mode = mode;
    return config;
}

std::uint64_t pair_counter(const sim::MachineResult& result, std::string_view name) {
    std::uint64_t sum = 0;
    for (const sim::UnitResult& unit : result.units) {
        if (!unit.name.ends_with("pair")) continue;
        for (const sim::CounterValue& counter : unit.counters)
            sum += counter.name == name ? counter.value : 0;
    }
    return sum;
}

// Cycles that the most used part of the pair units must at least be held, if all work were spread evenly.
double held_cycles(const AreaRow& row, const sim::Config& config) {
    const double testers = double(config.rtu.pair.testers) * config.rtu.count;
    const double hit_units = testers * std::max(1U, config.rtu.pair.hit_units);
    return std::max(double(row.tester_cycles) / testers, double(row.hit_unit_cycles) / hit_units);
}

AreaRow row_of(const sim::MachineResult& result, const sim::Config& config, const ModeArea& area) {
    AreaRow row;
    row.mode = area.mode;
    row.rays = result.ray_count;
    row.cycles = result.cycles;
    row.pair_tests = result.counts.pair_tests;
    row.triangle_tests = result.counts.triangle_tests;
    row.exact_tests = pair_counter(result, "exact_tests");
    row.replays = pair_counter(result, "replays");
    row.survivors = pair_counter(result, "survivors");
    row.tester_cycles = pair_counter(result, "tester_cycles");
    row.hit_unit_cycles = pair_counter(result, "hit_unit_cycles");
    row.mrps = mrps(row.rays, row.cycles, config.clock_mhz);
    row.mrps_per_mgate = mrps_per_mgate(config, result);
    const double held = held_cycles(row, config);
    row.pair_limit_mrps = held > 0 ? double(row.rays) / held * config.clock_mhz : 0;
    row.pair_limit_mrps_per_mgate = row.pair_limit_mrps / (area.pair.gates.gates * config.rtu.count / 1e6);
    return row;
}

void add_scene(const AreaOptions& options, const SceneSource& source, AreaReport& report) {
    const auto tell = [&](const std::string& phase) {
        if (options.progress) options.progress(source.name(), phase);
    };
    tell("reading");
    const LoadedScene loaded = load_scene(source);
    tell("building");
    const BuiltScene built = build_scene(loaded.mesh, {model::PairingKind::EdgeBbsa, 0},
                                         model::EdgeIdentity::Position, options.config.bvh);
    const ChosenCamera chosen = choose_camera(loaded.mesh, built.image, source, options.camera_file);
    for (const model::WorkloadKind kind : options.workloads) {
        const model::Workload workload =
            make_workload(kind, loaded.mesh, built.image, chosen.camera, options.resolution, options.seed);
        for (const ModeArea& area : report.modes) {
            const std::string_view mode = sim::pair_mode_names()[std::size_t(area.mode)];
            const sim::Config config = with_mode(options.config, area.mode);
            tell(fmt::format("{}, {}", workload.name, mode));
            AreaRow row =
                row_of(sim::simulate(config, built.image, workload.rays, workload.ray_kind), config, area);
            row.scene = source.name();
            row.workload = workload.name;
            report.rows.push_back(std::move(row));
        }
    }
}

}  // namespace

MachineArea machine_area(NamedConfig machine) {
    MachineArea area;
    area.parts = rtu_area(machine.config);
    area.machine = std::move(machine);
    return area;
}

AreaTotal MachineArea::unit(std::string_view name) const {
    std::vector<AreaPart> chosen;
    std::ranges::copy_if(parts, std::back_inserter(chosen),
                         [&](const auto& part) { return part.unit == name; });
    return total(chosen);
}

const AreaRow& in_mode(const AreaReport& report, const AreaRow& row, PairMode mode) {
    const auto found = std::ranges::find_if(report.rows, [&](const AreaRow& other) {
        return other.scene == row.scene && other.workload == row.workload && other.mode == mode;
    });
    RTU_CHECK(found != report.rows.end(), "{} {}: a mode is missing", row.scene, row.workload);
    return *found;
}

double scene_rate(const AreaReport& report, std::string_view scene, PairMode mode, double AreaRow::*rate) {
    double rays = 0, time = 0;
    for (const AreaRow& row : report.rows) {
        if (row.scene != scene || row.mode != mode || row.*rate <= 0) continue;
        rays += double(row.rays);
        time += double(row.rays) / (row.*rate);
    }
    return time > 0 ? rays / time : 0;
}

double saved_pair_percent(const AreaReport& report) {
    const auto gates = [&](PairMode mode) { return report.modes[std::size_t(mode)].pair.gates.gates; };
    return 100 * (1 - gates(PairMode::DualShared) / gates(PairMode::DualIndependent));
}

double saved_machine_percent(const AreaReport& report) {
    const auto gates = [&](PairMode mode) { return report.modes[std::size_t(mode)].machine_gates; };
    return 100 * (1 - gates(PairMode::DualShared) / gates(PairMode::DualIndependent));
}

AreaReport run_area_study(const AreaOptions& options) {
    AreaReport report;
    report.version = version();
    report.seed = options.seed;
    report.machine = machine_area({options.preset, options.config});
    for (const NamedConfig& preset : options.presets) report.presets.push_back(machine_area(preset));
    for (const PairMode mode : modes) {
        const MachineArea area = machine_area({options.preset, with_mode(options.config, mode)});
        report.modes.push_back({mode, area.unit("pair"), area.gates()});
    }
    for (const SceneSource& source : options.scenes) add_scene(options, source, report);
    return report;
}

}  // namespace rtu::study
