#include "model/pair_saving.hpp"

#include <limits>

#include "model/pair_candidates.hpp"

namespace rtu::model {

Aabb triangle_box(const IdentifiedMesh& mesh, std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Vec3 p = mesh.positions[a];
    Aabb box{p, p};
    box.extend(mesh.positions[b]);
    box.extend(mesh.positions[c]);
    return box;
}

PairAreas pair_areas(const Aabb& first, const Aabb& second) {
    Aabb both = first;
    both.extend(second);
    return {first.half_area(), second.half_area(), both.half_area()};
}

Matching match_by_saving(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    const auto value_of = [&mesh](std::uint32_t, std::uint32_t, HalfEdge first, HalfEdge second) {
        const auto saving = float(
            pair_areas(triangle_box(mesh, first.triangle()), triangle_box(mesh, second.triangle())).saving());
        return saving == saving ? saving : -std::numeric_limits<float>::infinity();
    };
    return match_greedily(sorted_candidates(mesh, memory, value_of), std::uint32_t(mesh.triangles.size()),
                          memory);
}

}  // namespace rtu::model
