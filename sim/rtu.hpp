#pragma once

#include <cstdint>
#include <systemc>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "sim/box_unit.hpp"
#include "sim/cache.hpp"
#include "sim/config.hpp"
#include "sim/fifo.hpp"
#include "sim/mailbox_region.hpp"
#include "sim/memory_message.hpp"
#include "sim/pair_unit.hpp"
#include "sim/ray_scheduler.hpp"
#include "sim/ray_slots.hpp"

namespace rtu::sim {

/// What an RTU works on: one image and rays of one kind.
struct RtuJob {
    const model::MemoryImage& image;
    model::RayKind kind;
    model::StackRegion stacks;
    MailboxRegion mailboxes;
};

/// One ray-tracing unit: scheduler, box unit, dual-triangle unit, L1, and the channels between them.
///
///   rays_in -> scheduler -> requests -> L1 -> nodes -> box unit ---> box_results -> scheduler -> hits_out
///                                          -> leaves -> pair unit -> pair_results ->
///                                          -> stack_blocks ------------------------>
class Rtu final : public sc_core::sc_module {
  public:
    /// `index`: which of the RTUs it is; the shared memory replies to it.
    Rtu(sc_core::sc_module_name name, ClockDomain& domain, const Config& config, std::uint32_t index,
        const RtuJob& job);

    Fifo<RayMessage> rays_in;
    Fifo<HitMessage> hits_out;
    Fifo<MemoryReply> fills_in;  ///< of the L1, from the shared memory

  private:
    RaySlots slots_;
    Fifo<MemoryRequest> requests_;
    Fifo<MemoryReply> nodes_, leaves_, stack_blocks_;
    Fifo<SlotToken> box_results_, pair_results_;

  public:
    RayScheduler scheduler;
    BoxUnit box;
    PairUnit pair;
    Cache l1;  ///< its port to the memory below is bound by whoever owns the RTU

    /// Throws std::logic_error unless everything that entered has left.
    void check_drained() const;
};

}  // namespace rtu::sim
