#pragma once

#include <limits>

#include "model/camera.hpp"
#include "model/sampling.hpp"

namespace rtu::model {

/// What all rays of a picture have in common, for making many of them.
class CameraFrame {
  public:
    CameraFrame(const Camera& camera, Resolution resolution)
        : camera_(camera),
          width_(float(resolution.width)),
          height_(float(resolution.height)),
          forward_(direction_between(camera.eye, camera.target).value_or(Vec3{0, 0, -1})),
          right_(direction_of(cross(forward_, camera.up)).value_or(Vec3{1, 0, 0})),
          up_(cross(right_, forward_)) {}

    /// camera_ray() of the pixel.
    [[nodiscard]] Ray ray(std::uint32_t x, std::uint32_t y) const {
        const float from_left = ((float(x) + 0.5F) / width_ * 2 - 1) * (width_ / height_);
        const float from_bottom = 1 - (float(y) + 0.5F) / height_ * 2;
        const Vec3 direction = forward_ + right_ * (from_left * camera_.tan_half_fov) +
                               up_ * (from_bottom * camera_.tan_half_fov);
        return {camera_.eye, 0, normalized(direction), std::numeric_limits<float>::infinity()};
    }

  private:
    Camera camera_;
    float width_, height_;
    Vec3 forward_, right_, up_;
};

}  // namespace rtu::model
