// Kernels of the methods that meet the triangle's plane and look where.

#include "model/methods/kernel_groups.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/methods/kernels_plane.cpp"
#include <hwy/foreach_target.h>  // before anything that is compiled for each instruction set

#include "model/methods/kernels-inl.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

using PlaneMethods =
    MethodList<SnyderBarr, Badouel, Wald, Shevtsov, ShevtsovDistanceFirst, HavelHerout, BaldwinWeber>;

void append_plane_kernels(std::vector<Kernel>& to) { add_all_kernels(PlaneMethods(), to); }

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();

#if HWY_ONCE
namespace rtu::model::methods {

HWY_EXPORT(append_plane_kernels);

void add_plane_kernels(std::vector<Kernel>& to) { HWY_DYNAMIC_DISPATCH(append_plane_kernels)(to); }

}  // namespace rtu::model::methods
#endif
