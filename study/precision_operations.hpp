#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/precision_area.hpp"

namespace rtu::study {

/// Operations of one test of that method whose triangle is hit, the division for t, u and v included; what is
/// done once a ray or a triangle is not. Requires the name of one of emulated_methods().
[[nodiscard]] TestOperations operations_of(std::string_view method);

/// The same of a method with a pair form, for two triangles with a common edge that are both hit: tested one
/// by one, and as a pair.
struct PairOperations {
    std::string method;  ///< MethodInfo::name
    std::string title;
    TestOperations one, two, pair;
};

/// Of all methods that have a pair form.
[[nodiscard]] std::vector<PairOperations> pair_operations();

}  // namespace rtu::study
