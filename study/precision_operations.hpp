#pragma once

#include <string_view>

#include "study/precision_area.hpp"

namespace rtu::study {

/// Operations of one test of that method whose triangle is hit, the division for t, u and v included; what is
/// done once a ray or a triangle is not. Requires the name of one of emulated_methods().
[[nodiscard]] TestOperations operations_of(std::string_view method);

}  // namespace rtu::study
