#include "study/sweep/sweep_plan.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "model/fingerprint.hpp"
#include "model/regular_file.hpp"
#include "study/scene_steps.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

std::string file_fingerprint(const std::filesystem::path& path) {
    model::RegularFile file(path);
    std::string digest, part;
    for (std::uint64_t left = file.size_bytes(); left > 0; left -= part.size()) {
        part.resize(std::min<std::uint64_t>(left, 1 << 20));
        file.read(part.data(), part.size());
        digest = model::hex_digits(model::fingerprint(digest + part));
    }
    return digest;
}

std::optional<std::filesystem::path> camera_file_of(const SweepFile& file, const SweepInput& input) {
    return input.camera_file ? input.camera_file : file.camera_file;
}

std::string camera_text(const SweepFile& file, const SweepInput& input) {
    const std::optional<std::filesystem::path> path = camera_file_of(file, input);
    if (!path) return "automatic";
    const auto camera = model::load_camera(*path, input.scene.name());
    if (!camera) return "automatic";
    const auto& [eye, target, up, tan_half_fov] = *camera;
    return fmt::format("{} {} {}, {} {} {}, {} {} {}, {}", eye.x, eye.y, eye.z, target.x, target.y, target.z,
                       up.x, up.y, up.z, tan_half_fov);
}

std::string rays_text(const SweepFile& file, const SweepInput& input) {
    if (input.rays) {
        return fmt::format("file {} {} {}", file_fingerprint(input.rays->file), int(input.rays->format),
                           traces::to_string(input.rays->import.kind));
    }
    std::vector<std::string_view> workloads;
    for (const model::WorkloadKind kind : file.workloads) workloads.push_back(to_string(kind));
    return fmt::format("{} {}x{} seed {} camera {}", fmt::join(workloads, ","), file.resolution.width,
                       file.resolution.height, input.seed.value_or(file.seed), camera_text(file, input));
}

std::string fingerprint_of(const std::vector<std::string>& parts) {
    return model::hex_digits(model::fingerprint(fmt::format("{}", fmt::join(parts, "\n"))));
}

std::string tree_text(const sim::Config::Bvh& bvh) {
    std::string text = fmt::format("{} {} {}", bvh.width, bvh.max_leaf_pairs, to_string(bvh.node_format));
    if (bvh.splits == sim::SplitKind::Spatial) {
        text += fmt::format(" spatial {}", bvh.split_budget_percent);
    }
    if (bvh.builder == sim::BvhBuilder::Morton) text += " morton";
    return text;
}

std::string fidelity_text(const SweepFile& file, FidelityLevel level) {
    if (!uses_tolerance(level)) return std::string(to_string(level));
    return fmt::format("{} {}", to_string(level), file.tolerance);
}

SweepPoint make_point(const SweepPlan& plan, std::size_t scene, std::size_t design, FidelityLevel level) {
    const SweepScene& where = plan.scenes[scene];
    const SweepDesign& what = plan.designs[design];
    const std::string program(version());
    return {
        fingerprint_of({program, where.hash, where.rays, fidelity_text(plan.file, level), what.id}),
        fingerprint_of({program, where.hash, where.rays, to_string(what.pairing),
                        std::string(model::to_string(plan.file.edge_identity)), tree_text(what.config.bvh),
                        level == FidelityLevel::Cycle ? "traversals" : "rays"}),
        design, scene, level};
}

void add_pass(SweepPlan& plan, FidelityLevel level) {
    for (std::size_t scene = 0; scene < plan.scenes.size(); ++scene) {
        for (std::size_t design = 0; design < plan.designs.size(); ++design) {
            plan.points.push_back(make_point(plan, scene, design, level));
        }
    }
}

}  // namespace

SweepPlan make_sweep_plan(SweepFile file) {
    SweepPlan plan;
    plan.designs = sweep_designs(file);
    for (const SweepInput& input : file.inputs) {
        const LoadedScene scene = load_scene(input.scene);
        plan.scenes.push_back(
            {input.name(), scene.input_hash, rays_text(file, input), scene.facts.triangle_count});
    }
    plan.file = std::move(file);
    add_pass(plan, plan.file.fidelity);
    if (plan.file.fidelity != FidelityLevel::Cycle) add_pass(plan, FidelityLevel::Cycle);
    return plan;
}

RunOptions run_options(const SweepPlan& plan, const SweepPoint& point) {
    const SweepFile& file = plan.file;
    const SweepDesign& design = plan.designs[point.design];
    RunOptions options;
    options.pairing = design.pairing;
    options.edge_identity = file.edge_identity;
    options.workloads = file.workloads;
    options.resolution = file.resolution;
    const SweepInput& input = file.inputs[point.scene];
    options.camera_file = camera_file_of(file, input);
    options.seed = input.seed.value_or(file.seed);
    options.rays = input.rays;
    options.preset = design.preset;
    options.config = design.config;
    return options;
}

}  // namespace rtu::study
