#include "model/value_noise.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "model/random.hpp"

namespace rtu::model {

namespace {

float blend(float a, float b, float share) { return a + (b - a) * (share * share * (3.0F - 2.0F * share)); }

}  // namespace

float value_noise(Vec3 p, std::uint32_t seed) {
    std::array<std::uint32_t, 3> cell{};
    Vec3 share;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float lattice = std::floor(p[axis]);
        cell[axis] = std::uint32_t(std::int32_t(lattice));
        share[axis] = p[axis] - lattice;
    }
    std::array<float, 8> corner{};
    for (std::uint32_t k = 0; k < corner.size(); ++k) {
        const auto bits =
            philox({cell[0] + (k & 1U), cell[1] + (k >> 1U & 1U), cell[2] + (k >> 2U), 0}, {seed, 0});
        corner[k] = float(bits[0] >> 8U) * 0x1p-24F;
    }
    const float low =
        blend(blend(corner[0], corner[1], share.x), blend(corner[2], corner[3], share.x), share.y);
    const float high =
        blend(blend(corner[4], corner[5], share.x), blend(corner[6], corner[7], share.x), share.y);
    return blend(low, high, share.z);
}

float ridged_noise(Vec3 p, int octaves) {
    float sum = 0;
    float weight = 0.5F;
    for (int octave = 0; octave < octaves; ++octave) {
        const float ridge = 1.0F - std::fabs(2.0F * value_noise(p, std::uint32_t(octave)) - 1.0F);
        sum += weight * ridge * ridge;
        weight *= 0.5F;
        p = p * 2.0F;
    }
    return sum;
}

}  // namespace rtu::model
