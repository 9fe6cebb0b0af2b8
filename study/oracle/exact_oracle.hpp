#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/mesh.hpp"
#include "model/ray.hpp"

namespace rtu::study {

/// What a ray meets, decided in rational arithmetic on the given floats: no rounding, no tolerance, no BVH.
struct ExactHits {
    /// Triangles at the least t in the ray's open interval, edges and corners included; several when surfaces
    /// touch or the ray runs through a common edge. Empty for a miss. Triangles of zero area or edge-on to
    /// the ray are never met.
    std::vector<std::uint32_t> nearest;
    /// The ray meets the inside of at least one triangle in its interval: it cannot slip past at an edge.
    bool has_interior_hit = false;

    /// Whether `answer` (a primitive id, or nothing for a miss) is right for a closest-hit ray. A ray that
    /// meets edges and corners only may be called a miss.
    [[nodiscard]] bool allows_closest(std::optional<std::uint32_t> answer) const;
    /// The same for an any-hit ray.
    [[nodiscard]] bool allows_any(bool answer) const;
};

/// Tests every triangle of the mesh: slow, for the few rays on which two faster tests disagree.
[[nodiscard]] ExactHits exact_hits(const model::TriangleMesh& mesh, const model::Ray& ray);

}  // namespace rtu::study
