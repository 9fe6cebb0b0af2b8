#include "study/fidelity/fidelity_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "study/cpu_time.hpp"
#include "study/fidelity/fidelity_machines.hpp"
#include "study/scene_steps.hpp"
#include "study/validate/validate_configs.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

constexpr auto pairing = "edge_bbsa";

class FidelityStudy {
  public:
    explicit FidelityStudy(const FidelityOptions& options) : options_(options), levels_(options.levels) {
        has_rtl_ = std::erase(levels_, FidelityLevel::Rtl) > 0;
        report_.version = version();
        report_.resolution = options.resolution;
        report_.seed = options.seed;
        report_.tolerance = options.tolerance;
    }

    FidelityReport run() {
        for (const SceneSource& scene : options_.scenes) compare_levels(scene);
        return std::move(report_);
    }

  private:
    void tell(const std::string& phase) const {
        if (options_.progress) options_.progress(phase);
    }

    void compare_levels(const SceneSource& source) {
        tell("loading " + source.name());
        const LoadedScene loaded = load_scene(source);
        for (const NamedMachine& machine : options_.machines) {
            const BuiltScene built = build_scene(loaded.mesh, model::parse_pairing_method(pairing),
                                                 model::EdgeIdentity::Position, machine.machine.config.bvh);
            const ChosenCamera chosen = choose_camera(loaded.mesh, built.image, source, options_.camera_file);
            const model::WorkloadSetting setting(loaded.mesh, built.image, chosen.camera, options_.resolution,
                                                 options_.seed);
            for (const model::WorkloadKind kind : options_.workloads) {
                const auto population = picture_population(kind, setting);
                compare_levels(source.name(), machine, built.image, *population);
            }
            const bool is_first =
                &source == &options_.scenes.front() && &machine == &options_.machines.front();
            if (is_first && options_.ranks_configurations) {
                const auto population = picture_population(options_.workloads.back(), setting);
                rank(source.name(), machine, built.image, *population);
            }
        }
        if (has_rtl_) compare_rtl(source, loaded);
    }

    // The RTL is a machine of its own, and slow: a small picture, through it and through the cycle model.
    void compare_rtl(const SceneSource& source, const LoadedScene& loaded) {
        const NamedMachine machine{"rtl", {validate_configs().front().config, {}}};
        const BuiltScene built = build_scene(loaded.mesh, model::parse_pairing_method(pairing),
                                             model::EdgeIdentity::Position, machine.machine.config.bvh);
        const ChosenCamera chosen = choose_camera(loaded.mesh, built.image, source, options_.camera_file);
        const model::WorkloadSetting setting(loaded.mesh, built.image, chosen.camera, options_.rtl_resolution,
                                             options_.seed);
        for (const model::WorkloadKind kind : options_.workloads) {
            const auto population = picture_population(kind, setting);
            const FidelityRow cycle =
                row_of(FidelityLevel::Cycle, source.name(), machine, built.image, *population);
            add(row_of(FidelityLevel::Rtl, source.name(), machine, built.image, *population), cycle);
            report_.rows.back().is_inside = std::nullopt;
        }
    }

    void compare_levels(const std::string& scene, const NamedMachine& machine,
                        const model::MemoryImage& image, const RayPopulation& population) {
        const FidelityRow cycle = row_of(FidelityLevel::Cycle, scene, machine, image, population);
        add(cycle, cycle);
        for (const FidelityLevel level : levels_) {
            add(row_of(level, scene, machine, image, population), cycle);
        }
    }

    FidelityRow row_of(FidelityLevel level, const std::string& scene, const NamedMachine& machine,
                       const model::MemoryImage& image, const RayPopulation& population) const {
        tell(fmt::format("{}, {}, {}: {}", scene, machine.name, population.name(), to_string(level)));
        FidelityRow row =
            fidelity_row(run_level(level, machine.machine.config, image, population, settings()),
                         machine.machine.config.clock_mhz);
        row.scene = scene;
        row.machine = machine.name;
        row.workload = population.name();
        row.level = to_string(level);
        return row;
    }

    void add(FidelityRow row, const FidelityRow& cycle) {
        row.total_rays = cycle.total_rays;
        if (cycle.mrps > 0) {
            row.error_percent = 100 * (row.mrps / cycle.mrps - 1);
            row.is_inside = row.mrps_low <= cycle.mrps && cycle.mrps <= row.mrps_high;
            row.speedup = row.host_rays_per_second / cycle.host_rays_per_second;
        }
        report_.rows.push_back(std::move(row));
    }

    void rank(const std::string& scene, const NamedMachine& base, const model::MemoryImage& image,
              const RayPopulation& population) {
        const std::vector<sim::Config> machines = ranked_machines(base.machine.config);
        const auto mrps_of = [&](FidelityLevel level, double& seconds) {
            std::vector<double> values;
            for (const sim::Config& config : machines) {
                tell(fmt::format("{}: ranking by {}, machine {} of {}", scene, to_string(level),
                                 values.size() + 1, machines.size()));
                const LevelResult result = run_level(level, config, image, population, settings());
                values.push_back(fidelity_row(result, config.clock_mhz).mrps);
                seconds += result.cpu_seconds;
            }
            return values;
        };
        double cycle_seconds = 0;
        const std::vector<double> truth = mrps_of(FidelityLevel::Cycle, cycle_seconds);
        const auto count = std::uint32_t(machines.size());
        report_.rankings.push_back({scene, population.name(), "cycle", count, 1.0, cycle_seconds});
        for (const FidelityLevel level : levels_) {
            double seconds = 0;
            const double tau = kendall_tau(truth, mrps_of(level, seconds));
            report_.rankings.push_back(
                {scene, population.name(), std::string(to_string(level)), count, tau, seconds});
        }
    }

    [[nodiscard]] SampledOptions settings() const { return {options_.tolerance, options_.seed}; }

    const FidelityOptions& options_;
    std::vector<FidelityLevel> levels_;  // without rtl
    bool has_rtl_ = false;
    FidelityReport report_;
};

}  // namespace

FidelityReport run_fidelity_study(const FidelityOptions& options) { return FidelityStudy(options).run(); }

FidelityRow fidelity_row(const LevelResult& result, std::uint32_t clock_mhz) {
    FidelityRow row;
    row.level = result.level;
    const CycleEstimate& estimate = result.estimate;
    if (estimate.cycles_per_ray > 0) {
        row.mrps = clock_mhz / estimate.cycles_per_ray;
        row.mrps_low = clock_mhz / estimate.high;
        row.mrps_high = clock_mhz / estimate.low;
    }
    row.simulated_rays = result.simulated_rays;
    row.traced_rays = result.traced_rays;
    row.total_rays = std::uint64_t(std::llround(estimate.rays));
    if (result.cpu_seconds > 0) row.host_rays_per_second = estimate.rays / result.cpu_seconds;
    row.account = result.account;
    return row;
}

double kendall_tau(const std::vector<double>& a, const std::vector<double>& b) {
    double concordant = 0, ties_in_a = 0, ties_in_b = 0, pairs = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = i + 1; j < a.size(); ++j) {
            const double sign = (a[i] - a[j]) * (b[i] - b[j]);
            ++pairs;
            if (a[i] == a[j]) ++ties_in_a;
            if (b[i] == b[j]) ++ties_in_b;
            concordant += sign > 0 ? 1 : sign < 0 ? -1 : 0;
        }
    }
    const double scale = std::sqrt((pairs - ties_in_a) * (pairs - ties_in_b));
    return scale > 0 ? concordant / scale : 0;
}

}  // namespace rtu::study
