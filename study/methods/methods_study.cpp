#include "study/methods/methods_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "sim/config.hpp"
#include "study/methods/methods_bench.hpp"
#include "study/methods/methods_leaf_mix.hpp"
#include "study/scene_steps.hpp"
#include "study/version.hpp"

namespace rtu::study {

namespace {

using model::methods::Form;
using model::methods::Kernel;

constexpr std::array all_forms{Form::Single, Form::Rays, Form::Triangles, Form::Pairs};

// Secondary rays start where a picture's rays hit; enough of them to sample from.
constexpr model::Resolution picture{256, 256};
constexpr std::uint32_t scene_rays = 1024;

template <class Container, class Value>
bool is_wanted(const Container& wanted, const Value& value) {
    return wanted.empty() || std::ranges::find(wanted, value) != wanted.end();
}

std::vector<Kernel> wanted_kernels(const MethodsOptions& options) {
    std::vector<Kernel> kernels;
    for (const Kernel& kernel : model::methods::all_kernels())
        if (is_wanted(options.methods, kernel.method.name) && is_wanted(options.forms, kernel.form))
            kernels.push_back(kernel);
    return kernels;
}

void tell(const MethodsOptions& options, const std::string& phase) {
    if (options.progress) options.progress(phase);
}

MethodsProgress progress_of(const MethodsOptions& options, std::string what) {
    return [&options, what = std::move(what)](double share) {
        tell(options, fmt::format("{}: {:.0f} %", what, share * 100));
    };
}

void measure_scene(const MethodsOptions& options, const SceneSource& source, std::span<const Kernel> kernels,
                   MethodsReport& report) {
    tell(options, fmt::format("{}: pairing and building the tree", source.name()));
    const LoadedScene scene = load_scene(source);
    const BuiltScene built = build_scene(scene.mesh, {model::PairingKind::EdgeBbsa},
                                         model::EdgeIdentity::Position, sim::Config{}.bvh);
    const model::Camera camera = choose_camera(scene.mesh, built.image, source, options.camera_file).camera;
    for (const model::WorkloadKind kind : options.workloads) {
        const model::Workload workload =
            make_workload(kind, scene.mesh, built.image, camera, picture, options.seed);
        const auto singles = leaf_mix(scene.mesh, built.image, workload, scene_rays, options.seed);
        const auto pairs = pair_mix(built.image, workload, scene_rays, options.seed);
        const std::string name = fmt::format("{}/{}", source.name(), workload.name);
        const auto measured =
            measure_leaf_mix(kernels, singles, pairs, name, options.repeats, progress_of(options, name));
        report.rows.insert(report.rows.end(), measured.begin(), measured.end());
        report.early_exits.push_back({name, early_exits(singles)});
    }
}

void measure_all_scaling(const MethodsOptions& options, std::span<const Kernel> kernels,
                         std::vector<MethodsScalingRow>& rows) {
    for (const Kernel& kernel : kernels) {
        const bool is_theirs = kernel.method.name == "moller_trumbore" || kernel.method.name == "badouel";
        if (kernel.form != Form::Single || !is_theirs) continue;
        tell(options, fmt::format("{}: number of tests", kernel.method.name));
        const auto measured = measure_scaling(kernel, options.seed, std::min(options.repeats, 5U));
        rows.insert(rows.end(), measured.begin(), measured.end());
    }
}

}  // namespace

void check_method_name(std::string_view name) {
    std::vector<std::string_view> known;
    for (const model::methods::Method& method : model::methods::all_methods())
        known.push_back(method.info.name);
    if (std::ranges::find(known, name) == known.end())
        throw Error("expected a ray-triangle method, one of {}; got '{}'", fmt::join(known, ", "),
                    model::one_line(name));
}

Form parse_form(std::string_view name) {
    for (const Form form : all_forms)
        if (name_of(form) == name) return form;
    throw Error("expected a form: single, rays, triangles or pairs; got '{}'", model::one_line(name));
}

MethodsReport run_methods_study(const MethodsOptions& options) {
    MethodsReport report{.version = std::string(version()),
                         .instruction_set = std::string(model::methods::instruction_set()),
                         .seed = options.seed,
                         .triangle_count = options.triangle_count,
                         .ray_count = options.ray_count,
                         .repeats = options.repeats,
                         .rows = {},
                         .scaling = {},
                         .early_exits = {}};
    const std::vector<Kernel> kernels = wanted_kernels(options);
    const auto workload = random_methods_workload(options.triangle_count, options.ray_count, options.seed);
    report.clock_hz = measure_clock_hz();
    report.rows = measure_methods(kernels, workload, options.repeats, progress_of(options, "random"));
    measure_all_scaling(options, kernels, report.scaling);
    for (const SceneSource& source : options.scenes) measure_scene(options, source, kernels, report);
    report.clock_hz = std::max(report.clock_hz, measure_clock_hz());
    return report;
}

}  // namespace rtu::study
