// Compiled with -ffp-contract=fast, in a namespace of its own and for processors that fuse.

#include <hwy/highway.h>

#define RTU_TARGET contracted
#if HWY_ARCH_X86
#define RTU_BEFORE_TARGET() HWY_PUSH_ATTRIBUTES("avx2,fma")
#define RTU_AFTER_TARGET() HWY_POP_ATTRIBUTES
#else
#define RTU_BEFORE_TARGET() HWY_BEFORE_NAMESPACE()
#define RTU_AFTER_TARGET() HWY_AFTER_NAMESPACE()
#endif

#include <vector>

#include "model/methods/contracted.hpp"
#include "model/methods/single_call-inl.hpp"

namespace rtu::model::methods {

std::span<const Method> contracted_methods() {
#if HWY_ARCH_X86
    if ((hwy::SupportedTargets() & HWY_AVX2) == 0) return {};
#endif
    static const std::vector<Method> methods = contracted::calls_of(contracted::AllMethods());
    return methods;
}

}  // namespace rtu::model::methods
