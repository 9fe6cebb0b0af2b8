#include "study/stability/stability_cases.hpp"

#include <algorithm>

namespace rtu::study {

std::vector<StabilityCase> stability_cases() {
    std::vector<StabilityCase> cases = surface_cases();
    for (auto& more : {triangle_cases(), consistency_cases()})
        cases.insert(cases.end(), more.begin(), more.end());
    std::sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    return cases;
}

}  // namespace rtu::study
