// The methods' arithmetic is compiled once for each instruction set. A header that ends in -inl.hpp, and
// every method's header, stands between these two and in the namespace methods::RTU_TARGET; methods-inl.hpp
// includes them all, once for each set, which is why they, and this header, have no
// include guard.

#include <hwy/highway.h>

#ifndef RTU_TARGET
#define RTU_TARGET HWY_NAMESPACE
#define RTU_BEFORE_TARGET() HWY_BEFORE_NAMESPACE()
#define RTU_AFTER_TARGET() HWY_AFTER_NAMESPACE()
#endif
