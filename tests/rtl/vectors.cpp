#include "vectors.hpp"

#include <cstdlib>
#include <string>

namespace rtu::test {

std::uint64_t vector_count(std::uint64_t by_default) {
    const char* const wanted = std::getenv("RTUSIM_RTL_VECTORS");
    return wanted != nullptr ? std::stoull(wanted) : by_default;
}

}  // namespace rtu::test
