#pragma once

#include <vector>

#include "model/methods/kernel.hpp"

// Kernels compiled in three parts, each for several instruction sets.

namespace rtu::model::methods {

/// Append the kernels of the methods that meet the triangle's plane first, that compare volumes, and that
/// shear.
void add_plane_kernels(std::vector<Kernel>& to);
void add_volume_kernels(std::vector<Kernel>& to);
void add_shear_kernels(std::vector<Kernel>& to);

}  // namespace rtu::model::methods
