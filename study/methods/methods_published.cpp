#include <array>

#include "study/methods/methods_report.hpp"

namespace rtu::study {

std::span<const PublishedSpeed> published_speeds() {
    static constexpr std::array speeds{
        PublishedSpeed{"wald", 109, 44, 390, 173, 26},
        PublishedSpeed{"shevtsov", 107, 46, 391, 179, 32.1},
        PublishedSpeed{"havel_herout", 115, 44, 427, 177, 35.5},
        PublishedSpeed{"havel_herout_sse4", 149, 48, std::nullopt, std::nullopt, 50.3},
    };
    return speeds;
}

}  // namespace rtu::study
