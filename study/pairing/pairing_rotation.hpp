#pragma once

#include <array>

#include "model/affine.hpp"
#include "model/camera.hpp"
#include "model/mesh.hpp"

namespace rtu::study {

/// Degrees about the x, the y and the z axis, applied in this order; right-handed.
using RotationDegrees = std::array<double, 3>;

/// The rotation about the origin. Exact at multiples of 90 degrees; else within a few units in the last place
/// of binary64, and bit-equal on every machine: sums and products only.
[[nodiscard]] model::Affine rotation(const RotationDegrees& degrees);

/// The mesh with its positions mapped, each rounded once; triangles, indices and name stay. Positions that
/// were bit-equal stay bit-equal. Throws Error when a coordinate leaves max_coordinate.
[[nodiscard]] model::TriangleMesh rotated(const model::TriangleMesh& mesh, const model::Affine& map);

/// The camera that sees of the rotated mesh what `camera` sees of the mesh.
[[nodiscard]] model::Camera rotated(const model::Camera& camera, const model::Affine& map);

}  // namespace rtu::study
