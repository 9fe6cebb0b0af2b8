#pragma once

// CSV of rays: a line of column names, then a line a ray; separated by commas, without quotes.
//   origin_x, origin_y, origin_z, direction_x, direction_y, direction_z    needed
//   t_min (0), t_max (inf), workload (rays), kind (closest; or any)        else as in brackets
//   pixel or parent                                                        no ids without
// Numbers are decimal, inf, -inf or nan.

#include <filesystem>
#include <memory>

#include "traces/ray_files.hpp"

namespace rtu::traces {

/// `options` replace the defaults of the columns workload and kind. Errors name file, line and column.
[[nodiscard]] std::unique_ptr<RayReader> open_csv_rays(const std::filesystem::path& path,
                                                       const ImportOptions& options);

/// The column of ids is `pixel`, or `parent` when the first rays say so; empty for rays without.
[[nodiscard]] std::unique_ptr<RayWriter> create_csv_rays(const std::filesystem::path& path);

}  // namespace rtu::traces
