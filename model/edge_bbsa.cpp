#include "model/edge_bbsa.hpp"

#include <cmath>
#include <limits>

namespace rtu::model {

float edge_box_area(Vec3 a, Vec3 b) {
    const float dx = std::fabs(a.x - b.x), dy = std::fabs(a.y - b.y), dz = std::fabs(a.z - b.z);
    const float area = dx * dy + dy * dz + dz * dx;
    return area >= 0 ? area : std::numeric_limits<float>::infinity();  // NaN: an infinite extent times zero
}

std::span<PairCandidate> edge_bbsa_candidates(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    return sorted_candidates(mesh, memory, [&](std::uint32_t lower, std::uint32_t upper, HalfEdge, HalfEdge) {
        return edge_box_area(mesh.positions[lower], mesh.positions[upper]);
    });
}

}  // namespace rtu::model
