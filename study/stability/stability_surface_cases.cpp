#include <fmt/format.h>

#include <array>

#include "model/builtin_sculptures.hpp"
#include "study/stability/stability_aims.hpp"
#include "study/stability/stability_cases.hpp"
#include "study/stability/stability_probes.hpp"

namespace rtu::study {
namespace {

// A closed mesh by name, at a place, under rays of one aim.
StabilitySetting on_mesh(std::string parameter, std::string_view name, Placement placement, Aim aim) {
    return {std::move(parameter), std::string(to_string(aim)), [=] {
                const ClosedMesh& mesh = closed_mesh(name);
                const auto surface = placed_surface(mesh.make(), placement);
                const bool is_along = aim == Aim::EdgeParallel || aim == Aim::InPlane;
                return surface_experiment(surface, rays_at(surface, mesh.inner_radius, placement, aim),
                                          is_along ? View::Along : View::Across);
            }};
}

std::vector<StabilitySetting> on_all_meshes(Aim aim) {
    std::vector<StabilitySetting> settings;
    for (const ClosedMesh& mesh : closed_meshes()) {
        settings.push_back(on_mesh(std::string(mesh.name), mesh.name, {}, aim));
    }
    return settings;
}

void append(std::vector<StabilitySetting>& settings, std::vector<StabilitySetting> more) {
    settings.insert(settings.end(), more.begin(), more.end());
}

StabilityCase shared_edge() {
    StabilityCase result{1, "shared_edge", "shared edges", "one hit where a closed surface is crossed", {}};
    append(result.settings, on_all_meshes(Aim::Edge));
    for (const char* name : {"cube", "box_grid", "ball"}) {
        result.settings.push_back(on_mesh(name, name, {}, Aim::EdgeMiddle));
    }
    return result;
}

StabilityCase shared_vertex() {
    StabilityCase result{2, "shared_vertex", "shared vertices", "one hit, whatever the valence", {}};
    append(result.settings, on_all_meshes(Aim::Vertex));
    for (const char* name : {"fan_16", "fan_128", "fan_1024", "needles"}) {
        result.settings.push_back(on_mesh(name, name, {}, Aim::Pole));
    }
    return result;
}

// Far away, binary32 leaves a mesh of size 1 only a coarse grid; from 1e7 on the mesh grows with it.
StabilityCase far_offset() {
    StabilityCase result{3, "far_offset", "far from the origin", "no leak at any offset or scale", {}};
    struct Offset {
        const char* name;
        Placement placement;
    };
    const std::array<Offset, 12> places{{{"0", {2, {}}},
                                         {"1e3", {2, {1e3F, -1e3F, 5e2F}}},
                                         {"1e4", {2, {1e4F, -1e4F, 5e3F}}},
                                         {"1e5", {2, {1e5F, -1e5F, 5e4F}}},
                                         {"148376", {2, {148376, 1234, -223423}}},
                                         {"1e6", {2, {1e6F, -1e6F, 5e5F}}},
                                         {"1e7", {64, {1e7F, -1e7F, 5e6F}}},
                                         {"scale 1e-6", {1e-6F, {}}},
                                         {"scale 1e-3", {1e-3F, {}}},
                                         {"scale 1e3", {1e3F, {}}},
                                         {"scale 1e6", {1e6F, {}}},
                                         {"scale 1e6, offset 1e7", {1e6F, {1e7F, -1e7F, 5e6F}}}}};
    for (const Offset& place : places) {
        for (const Aim aim : {Aim::Random, Aim::Edge, Aim::Vertex}) {
            result.settings.push_back(on_mesh(place.name, "ball", place.placement, aim));
        }
    }
    return result;
}

StabilityCase axis_aligned() {
    StabilityCase result{4, "axis_aligned", "rays along the axes", "one hit, for +0 and -0 alike", {}};
    for (const std::uint32_t squares : {4U, 16U}) {
        for (const Aim aim : {Aim::AxisVertex, Aim::AxisEdge, Aim::AxisDiagonal}) {
            result.settings.push_back(
                {fmt::format("{0} x {0} x 6 box", squares), std::string(to_string(aim)), [=] {
                     const auto surface = placed_surface(box_grid(squares), {});
                     return surface_experiment(surface, rays_at(surface, 0, {}, aim, squares));
                 }});
        }
    }
    return result;
}

StabilityCase silhouette() {
    StabilityCase result{5,
                         "silhouette",
                         "rays along edges, in planes and past silhouettes",
                         "as many hits as crossings: an even number from outside",
                         {}};
    for (const char* name : {"cube", "spiky", "torus"}) {
        for (const Aim aim : {Aim::OutsideVertex, Aim::OutsideEdge, Aim::EdgeParallel, Aim::InPlane}) {
            result.settings.push_back(on_mesh(name, name, {}, aim));
        }
    }
    return result;
}

StabilityCase fans() {
    StabilityCase result{20,
                         "fans",
                         "T-junctions, fans of three and more, folded pairs",
                         "all triangles on one side of an edge; no gap at an exact T",
                         {}};
    for (const std::uint32_t leaves : {2U, 3U, 5U, 9U}) {
        result.settings.push_back({fmt::format("{} leaves", leaves), "edge",
                                   [=] { return edge_experiment(fan_at_edge(leaves), leaves); }});
    }
    result.settings.push_back({"folded pair", "edge", [] { return fan_experiment(folded_pair(), 2); }});
    result.settings.push_back({"exact T", "edge", [] { return fan_experiment(t_junction(true), 3); }});
    result.settings.push_back({"rounded T", "edge", [] { return fan_experiment(t_junction(false), 3); }});
    return result;
}

StabilityCase watertight() {
    StabilityCase result{23,
                         "watertight",
                         "closed meshes at 15 offsets and scales, for very many rays",
                         "no leak, no double hit, no parity error",
                         {}};
    for (const ClosedMesh& mesh : closed_meshes()) {
        result.settings.push_back({std::string(mesh.name), "vertex, edge, random",
                                   [&mesh] { return watertight_experiment(everywhere(mesh)); }});
    }
    return result;
}

// The tree of a million triangles, built once for all aims.
std::shared_ptr<const Surface> million() {
    static std::weak_ptr<const Surface> known;
    std::shared_ptr<const Surface> surface = known.lock();
    if (!surface) known = surface = placed_surface(model::coral(8), {});
    return surface;
}

StabilityCase large_mesh() {
    StabilityCase result{22,
                         "large_mesh",
                         "1,310,720 triangles under ridged noise",
                         "an odd number of hits from inside, through tree and boxes",
                         {}};
    for (const Aim aim : {Aim::Vertex, Aim::Edge, Aim::Random}) {
        result.settings.push_back({"coral, 1,310,720 triangles", std::string(to_string(aim)), [=] {
                                       const auto surface = million();
                                       return inside_experiment(surface, rays_at(surface, 0.3F, {}, aim));
                                   }});
    }
    return result;
}

}  // namespace

std::vector<StabilityCase> surface_cases() {
    return {shared_edge(), shared_vertex(), far_offset(), axis_aligned(),
            silhouette(),  fans(),          large_mesh(), watertight()};
}

}  // namespace rtu::study
