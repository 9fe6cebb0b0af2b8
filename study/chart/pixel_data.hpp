#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/camera.hpp"
#include "model/memory_image.hpp"
#include "model/mesh.hpp"

namespace rtu::study {

/// Per pixel, what the pictures show; both vectors are [resolution.width * resolution.height], row by row.
struct PixelData {
    model::Resolution resolution;
    std::vector<std::optional<model::Vec3>>
        normals;  ///< hit triangle's unit normal facing the eye; nothing for a miss
    std::vector<std::uint32_t> box_tests;
};

/// What the pictures show, from the reference traversal of every pixel's primary ray, on all cores. Its hits
/// and box tests are those of the simulated machine, bit for bit.
[[nodiscard]] PixelData trace_pixels(const model::TriangleMesh& mesh, const model::MemoryImage& image,
                                     const model::Camera& camera, model::Resolution resolution);

}  // namespace rtu::study
