#include "vectors.hpp"

#include <cstdlib>
#include <string>

namespace rtu::test {

std::uint64_t vector_count(std::uint64_t by_default, std::uint64_t share) {
    const char* const wanted = std::getenv("RTUSIM_RTL_VECTORS");
    return wanted != nullptr ? std::stoull(wanted) / share : by_default;
}

}  // namespace rtu::test
