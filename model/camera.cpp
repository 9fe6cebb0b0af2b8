#include "model/camera.hpp"

#include "model/camera_frame.hpp"

namespace rtu::model {

Ray camera_ray(const Camera& camera, Resolution resolution, std::uint32_t x, std::uint32_t y) {
    return CameraFrame(camera, resolution).ray(x, y);
}

}  // namespace rtu::model
