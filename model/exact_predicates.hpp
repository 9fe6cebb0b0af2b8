#pragma once

#include "model/vec3.hpp"

namespace rtu::model {

/// True when the three finite points lie exactly on one line or coincide: no rounding is involved in the answer
/// while the exponents of the coordinates' differences span less than 30 binades; beyond that the answer is that of
/// 113-bit arithmetic.
[[nodiscard]] bool is_collinear(Vec3 a, Vec3 b, Vec3 c);

}  // namespace rtu::model
