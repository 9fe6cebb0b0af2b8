#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/ray.hpp"
#include "sim/cycle.hpp"
#include "sim/ray_supply.hpp"
#include "sim/ray_walk.hpp"

namespace rtu::sim {

/// A ray on its way into an RTU, and its index in the workload.
struct RayMessage {
    std::uint32_t ray_index = 0;
    SuppliedRay ray;
};

/// A finished ray on its way out.
struct HitMessage {
    std::uint32_t ray_index = 0;
    std::optional<model::Hit> hit;
};

/// "The ray of this slot": travels through an RTU in place of the ray's state. Whichever unit holds a slot's
/// token is the only one to touch the slot, so no unit ever sees another's state within a cycle.
struct SlotToken {
    std::uint32_t slot = 0;
};

/// One ray under way.
struct RaySlot {
    RayWalk walk;
    std::uint32_t ray_index = 0;
    std::size_t spilled = 0;                                  ///< lowest stack entries, that lie in memory
    bool waits_for_word = false;                              ///< of a mailbox in memory
    model::MailboxAnswer answer = model::MailboxAnswer::New;  ///< that the word will give
    Cycle accepted_cycle = 0;
};

/// An RTU's ray slots.
using RaySlots = std::vector<RaySlot>;

}  // namespace rtu::sim
