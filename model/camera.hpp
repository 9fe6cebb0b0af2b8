#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "model/memory_image.hpp"
#include "model/mesh.hpp"
#include "model/ray.hpp"

namespace rtu::model {

/// A pinhole camera. `tan_half_fov` is the tangent of half the vertical field of view.
struct Camera {
    Vec3 eye;
    Vec3 target;
    Vec3 up{0, 1, 0};
    float tan_half_fov = 0.5F;
};

/// Picture size in pixels, each side in [1, 16384].
struct Resolution {
    std::uint32_t width = 256;
    std::uint32_t height = 256;
};

/// The camera of table [scene_name] in a TOML file (keys eye, target, up, tan_half_fov), or nothing when the
/// file has no such table. A file with those keys at its top level serves every scene. Throws Error with file
/// and line for a file that cannot be read, an unknown or missing key, or a camera that sees nothing (eye =
/// target, a coordinate beyond max_coordinate, up parallel to the view, tan_half_fov outside (0, 100]).
[[nodiscard]] std::optional<Camera> load_camera(const std::filesystem::path& file,
                                                std::string_view scene_name);

/// A camera that shows the scene without being told how: outside looking at the whole of an object, or inside
/// when the scene is a room (judged by casting rays from the middle of its box). Deterministic.
[[nodiscard]] Camera automatic_camera(const TriangleMesh& mesh, const MemoryImage& image);

/// The ray through the centre of pixel (x, y); x runs right, y runs down. t in (0, infinity), direction of
/// length 1.
[[nodiscard]] Ray camera_ray(const Camera& camera, Resolution resolution, std::uint32_t x, std::uint32_t y);

}  // namespace rtu::model
