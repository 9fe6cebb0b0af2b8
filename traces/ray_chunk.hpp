#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/ray.hpp"

namespace rtu::traces {

/// What the ids of rays are.
enum class IdKind : std::uint8_t {
    None,
    Pixel,   ///< y * width + x of the ray's pixel
    Parent,  ///< index of the ray in another workload whose hit it starts from
};

/// Some rays of one workload, in the order in which they are handed to the machine.
struct RayChunk {
    std::string workload = "rays";  ///< see is_workload_name()
    model::RayKind kind = model::RayKind::ClosestHit;
    IdKind id_kind = IdKind::None;
    std::uint64_t first_ray = 0;  ///< index of rays[0] in the workload
    std::vector<model::Ray> rays;
    std::vector<std::uint32_t> ids;  ///< [rays.size()], or empty for IdKind::None
};

inline constexpr std::uint32_t most_chunk_rays = 1U << 16;
inline constexpr std::size_t name_bytes = 32;

/// 1 to 32 of the characters a-z, A-Z, 0-9, '_', '-' and '.'.
[[nodiscard]] bool is_workload_name(std::string_view name);

/// "closest" and "any".
[[nodiscard]] std::string_view to_string(model::RayKind kind);
/// Throws Error for anything but closest and any.
[[nodiscard]] model::RayKind parse_ray_kind(std::string_view text);
/// "none", "pixel" and "parent".
[[nodiscard]] std::string_view to_string(IdKind kind);

/// The payload of a block of rays.
[[nodiscard]] std::string encode(const RayChunk& chunk);
/// Reads it back, bit by bit; throws Error for what encode() cannot have written.
[[nodiscard]] RayChunk decode_ray_chunk(std::string_view payload);

}  // namespace rtu::traces
