// Kernels of the methods that compare volumes that the ray spans with edges.

#include "model/methods/kernel_groups.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/methods/kernels_volume.cpp"
#include <hwy/foreach_target.h>  // before anything that is compiled for each instruction set

#include "model/methods/kernels-inl.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

using VolumeMethods =
    MethodList<MollerTrumbore, PluckerPrecomputed, Plucker, PluckerTwoCross, MollerTrumboreDeferred,
               SeguraFeito, KenslerShirley, EmbreeMoller, EmbreePlucker, EdgePlane>;

void append_volume_kernels(std::vector<Kernel>& to) { add_all_kernels(VolumeMethods(), to); }

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();

#if HWY_ONCE
namespace rtu::model::methods {

HWY_EXPORT(append_volume_kernels);

void add_volume_kernels(std::vector<Kernel>& to) { HWY_DYNAMIC_DISPATCH(append_volume_kernels)(to); }

}  // namespace rtu::model::methods
#endif
