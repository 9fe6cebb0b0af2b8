#pragma once

#include <string_view>

#include "study/stability/stability_experiment.hpp"
#include "study/stability/stability_mesh.hpp"

namespace rtu::study {

/// What the rays of a surface are aimed at. From inside, unless said otherwise.
enum class Aim : std::uint8_t {
    Random,
    Edge,           ///< a random point of an edge
    EdgeMiddle,     ///< the middle of an edge
    Vertex,         ///< a vertex, to the bit
    Pole,           ///< vertex 0 or 1
    AxisVertex,     ///< along an axis, the other components +0 or -0, through a vertex of a box
    AxisEdge,       ///< the same through a random point of an edge
    AxisDiagonal,   ///< the same through a diagonal of the squares
    OutsideVertex,  ///< a vertex, from outside: among them those of the silhouette
    OutsideEdge,    ///< a random point of an edge, from outside
    EdgeParallel,   ///< along an edge, from outside
    InPlane         ///< in the plane of a triangle, as well as binary32 can say it
};

/// The name in results: "edge_middle".
[[nodiscard]] std::string_view to_string(Aim aim);

/// Where a closed mesh is put: scaled, then moved.
struct Placement {
    float scale = 1;
    model::Vec3 offset{};
};

/// Rays at a placed closed mesh. For axis aims the mesh must be box_grid(squares).
[[nodiscard]] DrawRay rays_at(const std::shared_ptr<const Surface>& surface, float inner_radius,
                              Placement placement, Aim aim, std::uint32_t squares = 0);

/// A closed mesh at offsets 0 to 1e7 and scales 1e-6 to 1e6, under rays at vertices, edges and anywhere, a
/// third each. Where binary32 is too coarse for the mesh, it is larger: 2^12 units in the last place at
/// least.
[[nodiscard]] std::vector<PlacedRays> everywhere(const ClosedMesh& mesh);

/// The closed mesh at its place.
[[nodiscard]] std::shared_ptr<const Surface> placed_surface(const model::TriangleMesh& mesh,
                                                            Placement placement);

}  // namespace rtu::study
