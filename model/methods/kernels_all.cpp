#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/methods/kernels_all.cpp"
#include <hwy/foreach_target.h>  // before anything that is compiled for each instruction set

#include "model/methods/exact.hpp"
#include "model/methods/kernels-inl.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

void add(std::vector<Kernel>& kernels) { add_all_kernels(AllMethods(), kernels); }

std::string_view set() { return hwy::TargetName(HWY_TARGET); }

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();

#if HWY_ONCE
namespace rtu::model::methods {

HWY_EXPORT(add);
HWY_EXPORT(set);

const std::vector<Kernel>& all_kernels() {
    static const std::vector<Kernel> kernels = [] {
        std::vector<Kernel> all;
        HWY_DYNAMIC_DISPATCH(add)(all);
        for (const Kernel& kernel : exact_kernels()) all.push_back(kernel);
        return all;
    }();
    return kernels;
}

std::string_view instruction_set() { return HWY_DYNAMIC_DISPATCH(set)(); }

}  // namespace rtu::model::methods
#endif
