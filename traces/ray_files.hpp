#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "traces/ray_stream.hpp"

namespace rtu::traces {

/// File formats of rays.
enum class RayFormat : std::uint8_t {
    Trace,      ///< traces/trace_reader.hpp
    Rays7,      ///< 7 little-endian f32 a ray: origin, direction, t_max; t_min = 0; no header
    Rays8,      ///< 8 little-endian f32 a ray: origin, t_min, direction, t_max; no header
    Csv,        ///< traces/csv_rays.hpp
    JsonLines,  ///< traces/json_rays.hpp
    Npy,        ///< traces/npy_header.hpp
};

/// What a format without names says of all its rays.
struct ImportOptions {
    std::string workload = "rays";
    model::RayKind kind = model::RayKind::ClosestHit;
};

/// Of trace, rays7, rays8, csv, jsonl, npy; throws Error for others.
[[nodiscard]] RayFormat parse_ray_format(std::string_view name);

/// The format of an existing file, by its first bytes (trace, npy) or its extension. Throws Error when
/// neither tells.
[[nodiscard]] RayFormat format_of_input(const std::filesystem::path& path);

/// The format that a file's extension names: .rtutrace, .rays7, .rays8, .csv, .jsonl or .npy; throws Error
/// for others.
[[nodiscard]] RayFormat format_of_output(const std::filesystem::path& path);

/// Throws Error when the file cannot be read or is not of the format.
[[nodiscard]] std::unique_ptr<RayReader> open_rays(const std::filesystem::path& path, RayFormat format,
                                                   const ImportOptions& options = {});

/// `header` is only kept by traces. Throws Error when the file cannot be written.
[[nodiscard]] std::unique_ptr<RayWriter> create_rays(const std::filesystem::path& path, RayFormat format,
                                                     const TraceHeader& header);

}  // namespace rtu::traces
