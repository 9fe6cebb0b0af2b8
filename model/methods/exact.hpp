#pragma once

#include <optional>
#include <vector>

#include "model/methods/kernel.hpp"
#include "model/methods/method.hpp"

namespace rtu::model::methods {

/// The machine's own test (model/pair_test.hpp) as a method: decided exactly on the given numbers, each edge
/// and vertex owned by one triangle. A ray or triangle with NaN or infinity, a degenerate triangle and an
/// empty interval are never hit.
[[nodiscard]] std::optional<TestHit> test_exactly(const Ray& ray, const Corners& triangle);

inline constexpr MethodInfo exact_info{.name = "exact",
                                       .title = "rtusim, exact",
                                       .source = "docs/model.md",
                                       .stored_bytes = 36,
                                       .axis_owner = AxisOwner::Ray};

/// Forms Single and Pairs, as the machine runs it: lone triangles and pairs of the memory image, scalar code.
[[nodiscard]] std::vector<Kernel> exact_kernels();

}  // namespace rtu::model::methods
