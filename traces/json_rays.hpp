#pragma once

// JSON lines of rays: an object a line.
//   "origin": [x, y, z], "direction": [x, y, z]                                    needed
//   "t_min": 0, "t_max": "inf", "workload": "rays", "kind": "closest" (or "any")   else as here
//   "pixel": 7 or "parent": 7                                                      no id without
// What is not finite is a string, "inf", "-inf" or "nan": JSON has no numbers for it.

#include <filesystem>
#include <memory>

#include "traces/ray_files.hpp"

namespace rtu::traces {

/// `options` replace the defaults of workload and kind. Errors name file, line and key.
[[nodiscard]] std::unique_ptr<RayReader> open_json_rays(const std::filesystem::path& path,
                                                        const ImportOptions& options);

[[nodiscard]] std::unique_ptr<RayWriter> create_json_rays(const std::filesystem::path& path);

}  // namespace rtu::traces
