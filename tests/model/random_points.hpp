#pragma once

#include "model/random.hpp"
#include "model/vec3.hpp"

namespace rtu::model {

/// A point of the unit cube.
inline Vec3 random_point(RandomStream& random) {
    const float x = random.next(), y = random.next(), z = random.next();
    return {x, y, z};
}

}  // namespace rtu::model
