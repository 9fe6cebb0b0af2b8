#pragma once

#include "model/vec3.hpp"

namespace rtu::model {

/// True when the three points lie exactly on one line or coincide; no rounding is involved in the answer,
/// whatever the finite coordinates. Source: exact expansions, [SHE97] (docs/model.md). Not for NaN or
/// infinity.
[[nodiscard]] bool is_collinear(Vec3 a, Vec3 b, Vec3 c);

}  // namespace rtu::model
