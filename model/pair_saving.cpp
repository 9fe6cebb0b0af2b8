#include "model/pair_saving.hpp"

#include <limits>

#include "model/aabb.hpp"
#include "model/pair_candidates.hpp"

namespace rtu::model {
namespace {

Aabb triangle_box(const IdentifiedMesh& mesh, std::uint32_t triangle) {
    Aabb box;
    for (const std::uint32_t vertex : mesh.triangles[triangle]) box.extend(mesh.positions[vertex]);
    return box;
}

}  // namespace

PairAreas pair_areas(const IdentifiedMesh& mesh, HalfEdge first, HalfEdge second) {
    const Aabb a = triangle_box(mesh, first.triangle()), b = triangle_box(mesh, second.triangle());
    Aabb both = a;
    both.extend(b);
    return {a.half_area(), b.half_area(), both.half_area()};
}

Matching match_by_saving(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    const auto value_of = [&mesh](std::uint32_t, std::uint32_t, HalfEdge first, HalfEdge second) {
        const auto saving = float(pair_areas(mesh, first, second).saving());
        return saving == saving ? saving : -std::numeric_limits<float>::infinity();
    };
    return match_greedily(sorted_candidates(mesh, memory, value_of), std::uint32_t(mesh.triangles.size()),
                          memory);
}

}  // namespace rtu::model
