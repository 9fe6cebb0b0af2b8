#include "study/stability/stability_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "model/parallel.hpp"
#include "study/stability/stability_scene.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

std::string compiler_version() {
#if defined(__clang__)
    return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    return "unknown";
#endif
}

std::vector<StabilityCase> chosen_cases(const StabilityOptions& options) {
    std::vector<StabilityCase> all = stability_cases();
    if (options.cases.empty()) return all;
    std::vector<StabilityCase> chosen;
    for (StabilityCase& each : all) {
        if (std::ranges::find(options.cases, each.name) != options.cases.end())
            chosen.push_back(std::move(each));
    }
    return chosen;
}

std::uint64_t rays_of(const Experiment& experiment, std::uint64_t rays) {
    constexpr std::uint64_t many = 256;
    const std::uint64_t triangles = experiment.triangles_per_ray();
    return triangles <= many ? rays : std::max<std::uint64_t>(1, rays * many / triangles);
}

std::vector<Tally> run_setting(const Experiment& experiment, Subjects subjects, std::uint64_t rays,
                               std::uint64_t seed, std::uint32_t purpose) {
    using Tallies = std::vector<Tally>;
    tbb::enumerable_thread_specific<Tallies> partial([&] { return Tallies(subjects.size()); });
    model::for_each_range<std::uint64_t>(rays, 16, [&](const auto& range) {
        Tallies& mine = partial.local();
        for (std::uint64_t i = range.begin(); i != range.end(); ++i) {
            model::RandomStream random(seed, purpose, std::uint32_t(i));
            experiment.examine(random, subjects, mine);
        }
    });
    Tallies sum(subjects.size());
    for (const Tallies& part : partial) {
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
    }
    return sum;
}

// Settings of a case, numbered from its own thousand: the rays of a case are the same whatever else is run.
std::uint32_t purpose_of(const StabilityCase& one, std::size_t setting) {
    return std::uint32_t(1000 * (one.number + 1)) + std::uint32_t(setting);
}

void add_rows(StabilityReport& report, const StabilitySetting& setting, const Experiment& experiment,
              Subjects subjects, std::vector<Tally> tallies) {
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        if (tallies[i].rays == 0) continue;
        report.rows.push_back({subjects[i]->name(), subjects[i]->contraction(), report.cases.size() - 1,
                               setting.parameter, setting.aim, experiment.measured(), std::move(tallies[i]),
                               setting.is_comparison});
    }
}

void check_names(const std::vector<std::string>& names, const std::vector<std::string>& known,
                 std::string_view option) {
    for (auto name = names.begin(); name != names.end(); ++name) {
        if (std::ranges::find(known, *name) == known.end()) {
            throw Error("{}: expected {}, got '{}'", option, fmt::join(known, ", "), model::one_line(*name));
        }
        if (std::find(names.begin(), name, *name) != name)
            throw Error("{}: '{}' is given twice", option, *name);
    }
}

}  // namespace

std::vector<std::string> stability_case_names() {
    std::vector<std::string> names;
    for (const StabilityCase& one : stability_cases()) names.push_back(one.name);
    return names;
}

void check_stability_options(const StabilityOptions& options) {
    check_names(options.cases, stability_case_names(), "--case");
    check_names(options.methods, subject_names(), "--method");
    RTU_CHECK(options.rays >= 1 && options.rays <= max_stability_rays, "{} rays", options.rays);
}

StabilityReport run_stability(const StabilityOptions& options) {
    check_stability_options(options);
    const auto subjects = make_subjects(options.methods);
    StabilityReport report{
        std::string(version()), compiler_version(), "", options.rays, options.seed, {}, {}, {}};
    report.methods = options.methods.empty() ? subject_names() : options.methods;

    std::vector<StabilityCase> cases = chosen_cases(options);
    if (options.scene) {
        if (options.cases.empty()) cases.clear();
        report.scene = options.scene->name();
        cases.push_back(scene_case(*options.scene));
    }
    std::unique_ptr<Experiment> experiment;  // the last one lives until the next is made: they may share
    for (const StabilityCase& one : cases) {
        report.cases.push_back({one.number, one.name, one.title, one.check});
        for (std::size_t i = 0; i < one.settings.size(); ++i) {
            const StabilitySetting& setting = one.settings[i];
            if (options.progress)
                options.progress(one.name, fmt::format("{}, {}", setting.parameter, setting.aim));
            experiment = setting.make();
            auto tallies = run_setting(*experiment, subjects, rays_of(*experiment, options.rays),
                                       options.seed, purpose_of(one, i));
            add_rows(report, setting, *experiment, subjects, std::move(tallies));
        }
    }
    return report;
}

std::uint64_t failures(const Measured& measured, const Tally& tally) {
    if (measured.doubles) return tally.leaks + tally.doubles;
    if (measured.crossings) return tally.leaks;
    if (measured.triangles) return tally.false_hits + tally.false_misses + tally.non_finite;
    if (measured.self_hits) return tally.self_hits;
    if (measured.variants) return tally.variant_errors;
    return measured.order ? tally.order_errors : tally.box_errors;
}

}  // namespace rtu::study
