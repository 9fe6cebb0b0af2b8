#pragma once

// NPY, the array format of NumPy (numpy.lib.format), as far as rays need it:
//   6 bytes  93 4e 55 4d 50 59            ("NUMPY")
//   u8, u8   version: 1.0, 2.0 or 3.0
//   u16 (version 1) or u32                length of the text that follows
//   text     {'descr': '<f4', 'fortran_order': False, 'shape': (N, 8), }, blanks, line feed
//   f32[N][8]                             origin x, y, z, t_min, direction x, y, z, t_max

#include <cstdint>
#include <filesystem>
#include <string>

#include "traces/raw_rays.hpp"

namespace rtu::traces {

/// Where the rays of an NPY file begin, and how many there are. Throws Error, naming the file and what it has
/// instead, for anything but little-endian binary32 in C order and of shape [ray_count, 8].
[[nodiscard]] RawLayout read_npy_header(const std::filesystem::path& path);

/// The header of such a file, version 1.0; always 128 bytes.
[[nodiscard]] std::string npy_header(std::uint64_t ray_count);

}  // namespace rtu::traces
