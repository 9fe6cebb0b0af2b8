#include "study/validate/validate_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "sim/machine.hpp"
#include "study/cpu_time.hpp"
#include "study/scene_steps.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

// A square picture with at least that many pixels.
model::Resolution picture_for(std::uint32_t pixels) {
    const auto side = std::uint32_t(std::ceil(std::sqrt(double(pixels))));
    return {side, side};
}

std::vector<model::Ray> spread(std::span<const model::Ray> rays, std::size_t count) {
    if (rays.size() <= count) return {rays.begin(), rays.end()};
    std::vector<model::Ray> chosen;
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(rays[i * rays.size() / count]);
    return chosen;
}

std::string words(const std::optional<model::Hit>& hit) {
    if (!hit) return "a miss";
    return fmt::format("triangle {} at t {} u {} v {}", hit->primitive_id, hit->t, hit->u, hit->v);
}

std::uint64_t spilled_entries(const sim::MachineResult& result) {
    std::uint64_t sum = 0;
    for (const sim::UnitResult& unit : result.units) {
        for (const sim::CounterValue& counter : unit.counters) {
            sum += counter.name == "spilled_entries" ? counter.value : 0;
        }
    }
    return sum;
}

// The simulator is what is expected here only because one of the two has to come first.
std::optional<ValidateDifference> difference(const sim::MachineResult& sim, const ReferenceResult& rtl) {
    for (std::size_t i = 0; i < sim.hits.size(); ++i) {
        if (i < rtl.hits.size() && sim.hits[i] == rtl.hits[i]) continue;
        const std::string got = i < rtl.hits.size() ? words(rtl.hits[i]) : "no answer";
        return ValidateDifference{"", "", "", i, fmt::format("expected {}, got {}", words(sim.hits[i]), got)};
    }
    const std::array counts{
        std::tuple{"node visits", sim.counts.node_visits, rtl.counts.node_visits},
        std::tuple{"box tests", sim.counts.box_tests, rtl.counts.box_tests},
        std::tuple{"pair tests", sim.counts.pair_tests, rtl.counts.pair_tests},
        std::tuple{"triangle tests", sim.counts.triangle_tests, rtl.counts.triangle_tests},
        std::tuple{"leaves known to a mailbox", sim.counts.mailbox_hits, rtl.counts.mailbox_hits},
        std::tuple{"spilled stack entries", spilled_entries(sim), rtl.spilled_entries}};
    for (const auto& [name, expected, got] : counts) {
        if (expected == got) continue;
        return ValidateDifference{"", "", "", {}, fmt::format("expected {} {}, got {}", expected, name, got)};
    }
    return std::nullopt;
}

std::uint64_t side_tests_of(const model::MemoryImage& image, const model::Ray& ray, model::RayKind kind) {
    model::Traversal walk;
    std::uint64_t side_tests = 0;
    bool goes_on = model::start(walk, image, ray, kind);
    while (goes_on) {
        const model::NodeRef at = walk.current.ref;
        if (!at.is_leaf()) model::visit_node(walk, image);
        for (std::uint32_t i = 0; at.is_leaf() && i < at.pair_count() && !model::is_satisfied(walk); ++i) {
            side_tests += model::visit_pair(walk, image, i).side_tests;
        }
        goes_on = !model::is_satisfied(walk) && model::pop(walk, 0);
    }
    return side_tests;
}

// One scene, with an image of every width that a machine wants.
class Bench {
  public:
    Bench(const ValidateOptions& options, const SceneSource& source, ValidateReport& report)
        : options_(options), source_(source), report_(report) {
        tell("reading");
        loaded_ = load_scene(source);
    }

    void run() {
        for (const ValidateConfig& config : options_.configs) {
            for (const model::WorkloadKind kind : options_.workloads) {
                if (!compare(config, kind)) return;
            }
        }
    }

  private:
    void tell(const std::string& phase) const {
        if (options_.progress) options_.progress(source_.name(), phase);
    }

    const model::MemoryImage& image(const sim::Config::Bvh& bvh) {
        auto& built = images_[{bvh.width, bvh.splits, bvh.split_budget_percent}];
        if (!built) {
            tell("building");
            built = build_scene(loaded_.mesh, {model::PairingKind::EdgeBbsa, 0},
                                model::EdgeIdentity::Position, bvh);
        }
        return built->image;
    }

    // The rays depend on the hits only, and so on no tree.
    const model::Workload& workload(model::WorkloadKind kind, const model::MemoryImage& image) {
        auto& made = workloads_[kind];
        if (!made) {
            if (!camera_) camera_ = choose_camera(loaded_.mesh, image, source_, options_.camera_file);
            made = make_workload(kind, loaded_.mesh, image, camera_->camera, picture_for(options_.ray_count),
                                 options_.seed);
        }
        return *made;
    }

    // False: they differ.
    bool compare(const ValidateConfig& config, model::WorkloadKind kind) {
        const model::MemoryImage& tree = image(config.config.bvh);
        const model::Workload& made = workload(kind, tree);
        const std::vector<model::Ray> rays = spread(made.rays, rays_for(options_.ray_count, config.config));
        if (rays.empty()) return true;  // a picture in which every primary ray misses
        tell(fmt::format("{}, {}", config.name, made.name));
        ValidateRow row;
        row.scene = source_.name();
        row.workload = made.name;
        row.config = config.name;
        row.rays = rays.size();
        row.clock_mhz = config.config.clock_mhz;
        const double start = cpu_seconds();
        const sim::MachineResult sim =
            sim::simulate(config.simulated.value_or(config.config), tree, rays, made.ray_kind);
        const double between = cpu_seconds();
        const ReferenceResult rtl = options_.reference(config.config, tree, rays, made.ray_kind);
        row.sim_cpu_seconds = between - start;
        row.rtl_cpu_seconds = cpu_seconds() - between;
        row.sim_cycles = sim.cycles;
        for (const model::Ray& ray : rays) row.side_tests += side_tests_of(tree, ray, made.ray_kind);
        row.rtl_cycles = rtl.cycles;
        row.hits =
            std::uint64_t(std::ranges::count_if(sim.hits, [](const auto& hit) { return hit.has_value(); }));
        report_.difference = difference(sim, rtl);
        if (report_.difference) {
            report_.difference->scene = row.scene;
            report_.difference->workload = row.workload;
            report_.difference->config = row.config;
            return false;
        }
        report_.rows.push_back(std::move(row));
        return true;
    }

    const ValidateOptions& options_;
    const SceneSource& source_;
    ValidateReport& report_;
    LoadedScene loaded_;
    std::map<std::tuple<std::uint32_t, sim::SplitKind, std::uint32_t>, std::optional<BuiltScene>> images_;
    std::optional<ChosenCamera> camera_;
    std::map<model::WorkloadKind, std::optional<model::Workload>> workloads_;
};

}  // namespace

double ValidateRow::error_percent() const {
    return rtl_cycles == 0 ? 0 : 100 * (double(sim_cycles) - double(rtl_cycles)) / double(rtl_cycles);
}

ErrorSummary error_summary(std::span<const ValidateRow> rows) {
    ErrorSummary summary;
    std::vector<double> errors;
    for (const ValidateRow& row : rows) errors.push_back(std::abs(row.error_percent()));
    if (errors.empty()) return summary;
    std::ranges::sort(errors);
    summary.rows = errors.size();
    summary.worst_percent = errors.back();
    summary.median_percent = (errors[(errors.size() - 1) / 2] + errors[errors.size() / 2]) / 2;
    summary.within_2_percent = std::uint64_t(std::ranges::upper_bound(errors, 2.0) - errors.begin());
    return summary;
}

ExactRows exact_rows(std::span<const ValidateRow> rows) {
    ExactRows counted;
    for (const ValidateRow& row : rows) {
        if (row.side_tests > 0) continue;
        ++counted.without_side_tests;
        counted.exact += row.sim_cycles == row.rtl_cycles ? 1 : 0;
    }
    return counted;
}

double speedup(std::span<const ValidateRow> rows) {
    double rtl = 0, sim = 0;
    for (const ValidateRow& row : rows) {
        rtl += row.rtl_cpu_seconds;
        sim += row.sim_cpu_seconds;
    }
    return sim > 0 ? rtl / sim : 0;
}

std::uint32_t rays_for(std::uint32_t ray_count, const sim::Config& config) {
    constexpr std::uint32_t enough_slots = 16, least = 32;
    if (config.rtu.ray_slots >= enough_slots) return ray_count;
    const auto fewer = std::uint32_t(std::uint64_t(ray_count) * config.rtu.ray_slots / enough_slots);
    return std::min(ray_count, std::max(least, fewer));
}

ValidateReport run_validation(const ValidateOptions& options) {
    ValidateReport report;
    report.version = version();
    report.seed = options.seed;
    report.configs = options.configs;
    report.sim_sets = options.sim_sets;
    for (const SceneSource& source : options.scenes) {
        if (!report.difference) Bench(options, source, report).run();
    }
    return report;
}

}  // namespace rtu::study
