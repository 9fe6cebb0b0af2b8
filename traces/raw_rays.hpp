#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "traces/ray_stream.hpp"

namespace rtu::traces {

struct ImportOptions;

/// Rays as little-endian f32 one after another: origin, [t_min,] direction, t_max.
struct RawLayout {
    std::uint32_t floats_per_ray = 8;        ///< 7: without t_min, which is 0
    std::uint64_t offset = 0;                ///< of the first, in bytes
    std::optional<std::uint64_t> ray_count;  ///< none: to the end of the file
};

/// Throws Error when the file is not a whole number of rays, or not the number it should have.
[[nodiscard]] std::unique_ptr<RayReader> open_raw_rays(const std::filesystem::path& path,
                                                       const RawLayout& layout, const ImportOptions& options);

enum class RawHeader : std::uint8_t { None, Npy };

/// With 7 floats a ray, add() throws Error for one whose t_min is not 0; for a second workload always.
[[nodiscard]] std::unique_ptr<RayWriter> create_raw_rays(const std::filesystem::path& path,
                                                         std::uint32_t floats_per_ray, RawHeader header);

}  // namespace rtu::traces
