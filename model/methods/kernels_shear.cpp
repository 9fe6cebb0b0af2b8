// Kernels of the methods that shear vertices into the ray's view.

#include "model/methods/kernel_groups.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/methods/kernels_shear.cpp"
#include <hwy/foreach_target.h>  // before anything that is compiled for each instruction set

#include "model/methods/kernels-inl.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

using ShearMethods = MethodList<Woop, WoopDouble, WoopTopLeft, WoopExact>;

void append_shear_kernels(std::vector<Kernel>& to) { add_all_kernels(ShearMethods(), to); }

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();

#if HWY_ONCE
namespace rtu::model::methods {

HWY_EXPORT(append_shear_kernels);

void add_shear_kernels(std::vector<Kernel>& to) { HWY_DYNAMIC_DISPATCH(append_shear_kernels)(to); }

}  // namespace rtu::model::methods
#endif
