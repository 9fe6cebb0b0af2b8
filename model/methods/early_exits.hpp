#pragma once

#include <cstdint>
#include <span>

#include "model/methods/method.hpp"

namespace rtu::model::methods {

/// How often the two halves of Shevtsov's test reject [SSK07]: the distance (t in the interval) and the
/// aperture (u and v in the triangle). Their order decides how often the first one is enough: distance first,
/// `by_both + by_distance_only` of `tests`; aperture first, `by_both + by_aperture_only`.
struct EarlyExits {
    std::uint64_t tests = 0;
    std::uint64_t by_both = 0, by_distance_only = 0, by_aperture_only = 0;
    std::uint64_t hits = 0;  ///< rejected by neither
    friend bool operator==(const EarlyExits&, const EarlyExits&) = default;
};

/// Of ray i against triangle i, each t in its ray's interval: the caller pairs them as its traversal does.
/// Throws std::logic_error unless there are as many rays as triangles.
[[nodiscard]] EarlyExits count_early_exits(std::span<const Ray> rays, std::span<const Corners> triangles);

}  // namespace rtu::model::methods
