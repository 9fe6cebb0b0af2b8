#include "model/camera.hpp"

#include "model/sampling.hpp"

namespace rtu::model {

Ray camera_ray(const Camera& camera, Resolution resolution, std::uint32_t x, std::uint32_t y) {
    const Vec3 forward = direction_between(camera.eye, camera.target).value_or(Vec3{0, 0, -1});
    const Vec3 right = direction_of(cross(forward, camera.up)).value_or(Vec3{1, 0, 0});
    const Vec3 up = cross(right, forward);
    const auto width = float(resolution.width), height = float(resolution.height);
    const float from_left = ((float(x) + 0.5F) / width * 2 - 1) * (width / height);
    const float from_bottom = 1 - (float(y) + 0.5F) / height * 2;
    const Vec3 direction =
        forward + right * (from_left * camera.tan_half_fov) + up * (from_bottom * camera.tan_half_fov);
    return {camera.eye, 0, normalized(direction), std::numeric_limits<float>::infinity()};
}

}  // namespace rtu::model
