#pragma once

#include <cstddef>
#include <cstdint>

#include "model/ray.hpp"

// What moves between the host and the machine, and how many bytes that is.

namespace rtu::sim {

/// A ray as it is: origin, direction and interval.
inline constexpr std::uint32_t ray_bytes = sizeof(model::Ray);
/// What a ray hits: t, u, v and the triangle's index; a miss has the same size.
inline constexpr std::uint32_t hit_bytes = sizeof(model::Hit);
static_assert(ray_bytes == 32 && hit_bytes == 16);

/// Work that the host sends in one transfer and gets the results of in another.
struct LinkBatch {
    std::uint32_t items = 0;       ///< what the machine reports one by one as finished: rays, or the batch
    std::uint64_t up_bytes = 0;    ///< at least 1
    std::uint64_t down_bytes = 0;  ///< 0: nothing is read back
};

/// A batch has arrived in the machine.
struct BatchArrival {
    std::uint64_t batch = 0;  ///< counted from 0, in the order of sending
    std::uint32_t bytes = 0;
    friend bool operator==(const BatchArrival&, const BatchArrival&) = default;
};

/// Items of the oldest batches have been finished in the machine.
struct ItemsFinished {
    std::uint32_t count = 0;
};

}  // namespace rtu::sim
