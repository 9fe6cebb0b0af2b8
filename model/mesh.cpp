#include "model/mesh.hpp"

#include <algorithm>

#include "model/exact_predicates.hpp"

namespace rtu::model {

Aabb bounds(const TriangleMesh& mesh) {
    Aabb box;
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            box.extend(mesh.positions[vertex]);
        }
    }
    return box;
}

bool is_degenerate(const TriangleMesh& mesh, const Triangle& triangle) {
    return is_collinear(mesh.positions[triangle[0]], mesh.positions[triangle[1]],
                        mesh.positions[triangle[2]]);
}

std::uint64_t count_degenerate(const TriangleMesh& mesh) {
    return std::uint64_t(std::ranges::count_if(
        mesh.triangles, [&](const Triangle& triangle) { return is_degenerate(mesh, triangle); }));
}

}  // namespace rtu::model
