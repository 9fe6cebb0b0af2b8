#pragma once

#include <cstdint>
#include <span>

#include "model/mesh.hpp"
#include "model/scratch_memory.hpp"

namespace rtu::model {

/// For every vertex the lowest vertex whose position has the same bits: [positions.size()]. +0 and -0 differ.
[[nodiscard]] std::span<std::uint32_t> weld_positions(std::span<const Vec3> positions, ScratchMemory& memory);

/// A mesh and, for every vertex, the lowest one that is the same vertex where edges are compared.
struct IdentifiedMesh {
    std::span<const Triangle> triangles;
    std::span<const Vec3> positions;
    std::span<const std::uint32_t> vertex_ids;  ///< [positions.size()]

    /// A triangle's corners by vertex identity.
    [[nodiscard]] Triangle corners(std::uint32_t triangle) const {
        const Triangle& t = triangles[triangle];
        return {vertex_ids[t[0]], vertex_ids[t[1]], vertex_ids[t[2]]};
    }
};

}  // namespace rtu::model
