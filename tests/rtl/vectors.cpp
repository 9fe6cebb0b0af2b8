#include "vectors.hpp"

#include <cstdlib>
#include <string>

namespace rtu::test {

namespace {

std::uint64_t wanted(const char* variable, std::uint64_t otherwise) {
    const char* const text = std::getenv(variable);
    return text != nullptr ? std::stoull(text) : otherwise;
}

}  // namespace

std::uint64_t vector_count(std::uint64_t by_default) { return wanted("RTUSIM_RTL_VECTORS", by_default); }

std::uint64_t vector_seed(std::uint64_t by_default) {
    return by_default + 1000 * wanted("RTUSIM_RTL_SEED", 0);
}

}  // namespace rtu::test
