#include "study/fidelity/spread_sample.hpp"

#include <algorithm>

#include "model/random.hpp"

namespace rtu::study {

std::vector<std::size_t> spread_sample(std::size_t have, std::size_t want, std::uint64_t seed,
                                       std::uint32_t purpose) {
    const std::size_t count = std::min(have, want);
    std::vector<std::size_t> chosen(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = i * have / count, end = (i + 1) * have / count;
        model::RandomStream random(seed, purpose, std::uint32_t(i));
        chosen[i] = begin + std::size_t(random.next() * float(end - begin));
    }
    return chosen;
}

}  // namespace rtu::study
