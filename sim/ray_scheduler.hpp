#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "model/stack_region.hpp"
#include "sim/clocked_unit.hpp"
#include "sim/config.hpp"
#include "sim/counters.hpp"
#include "sim/fifo.hpp"
#include "sim/mailbox_region.hpp"
#include "sim/memory_message.hpp"
#include "sim/pipeline.hpp"
#include "sim/ray_slots.hpp"

namespace rtu::sim {

/// Which unit an L1 reply goes to: MemoryRequest::source of the scheduler's requests.
enum class ReplyTo : std::uint8_t { BoxUnit, PairUnit, Scheduler };
inline constexpr std::uint32_t reply_channel_count = 3;

/// Gives rays their slots, decides what each asks memory for next, and hands finished rays back.
///
/// A cycle, from the output end: up to `results_per_cycle` results (of the pair unit, then the box unit, then
/// one stack block read back; the first served alternates) are taken; those taken `scheduler.latency_cycles`
/// ago advance their rays: pop the stack, skipping entries behind the best hit (by comparison of all entries
/// at once: no cycle each), and queue the next request, or hand the hit out; then up to `fetches_per_cycle`
/// requests leave in the order in which they were queued, one of them a write at most; then one new ray is
/// accepted. When a stack outgrows `stack_entries`, its lowest block is written to memory ahead of the ray's
/// next fetch; when the entries on chip run out, the last block written is read back.
///
/// Before a leaf is asked for, the ray's mailbox (model::Mailbox) is. One on chip answers within the
/// decision; a ray whose leaf is known is decided on again as if it had been a result: it is taken, before
/// the results of the units and as one of `results_per_cycle`, in the next cycle, so that each known leaf
/// takes `scheduler.latency_cycles` + 1 cycles. The word of a mailbox in memory is read through the L1 and
/// comes back as a stack block does; what is known then is popped in the same decision, and for what is not
/// the word is written, ahead of the fetch.
class RayScheduler final : public ClockedUnit {
  public:
    RayScheduler(sc_core::sc_module_name name, ClockDomain& domain, const Config::Rtu& config,
                 const model::MemoryImage& image, model::RayKind kind, RaySlots& slots,
                 model::StackRegion region, MailboxRegion mailboxes = {});

    sc_core::sc_port<Fifo<RayMessage>> rays_in{"rays_in"};
    sc_core::sc_port<Fifo<SlotToken>> box_results_in{"box_results_in"};
    sc_core::sc_port<Fifo<SlotToken>> pair_results_in{"pair_results_in"};
    sc_core::sc_port<Fifo<MemoryReply>> stack_blocks_in{"stack_blocks_in"};  ///< tag = slot
    sc_core::sc_port<Fifo<MemoryRequest>> requests_out{"requests_out"};
    sc_core::sc_port<Fifo<HitMessage>> hits_out{"hits_out"};

    [[nodiscard]] const SchedulerCounters& counters() const { return counters_; }
    [[nodiscard]] const MailboxCounters& mailbox_counters() const { return mailbox_counters_; }
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;
    /// Throws std::logic_error unless every slot is free again and every spilled entry that its ray needed
    /// was read back: all of a closest-hit ray, which ends with an empty stack; an any-hit ray may leave
    /// some.
    void check_drained() const;

  protected:
    Activity tick(Cycle now) override;

  private:
    /// A result that was taken.
    struct Result {
        std::uint32_t slot = 0;
        bool is_from_memory = false;  ///< a stack block, or the word of a mailbox
    };

    bool take(Cycle now);
    bool decide(Cycle now);
    bool issue(Cycle now);
    bool accept(Cycle now);
    [[nodiscard]] std::optional<Result> next_result(std::uint32_t source, Cycle now);
    [[nodiscard]] bool can_take_more(Cycle now) const;
    void advance(std::uint32_t slot, Cycle now);
    void finish(std::uint32_t slot, Cycle now);
    void look_up(std::uint32_t slot);
    void use_word(std::uint32_t slot, Cycle now);
    void use_stack_block(std::uint32_t slot, Cycle now);
    void count_known(model::NodeRef leaf);
    void queue_fetch(std::uint32_t slot);
    void queue_spill(std::uint32_t slot);
    void queue_reload(std::uint32_t slot);
    void queue_word(std::uint32_t slot, bool is_write);
    [[nodiscard]] MemoryRequest stack_request(std::uint32_t slot, std::size_t first_entry,
                                              bool is_write) const;
    [[nodiscard]] bool has_work(Cycle now) const;

    Config::Rtu config_;
    std::uint32_t spill_block_;
    std::uint64_t node_bytes_;
    const model::MemoryImage& image_;
    model::RayKind kind_;
    RaySlots& slots_;
    model::StackRegion region_;
    std::vector<std::uint32_t> free_slots_;
    Pipeline<Result> deciding_;
    std::deque<MemoryRequest> queued_;  // a fetch a slot at most, and its writes
    MailboxRegion mailboxes_;
    model::MailboxOptions mailbox_;
    bool looks_up_;                     // whether leaves are looked up, if only to count duplicates
    std::deque<std::uint32_t> passed_;  // slots whose leaf was known: to be decided on again
    std::uint32_t first_source_ = 0;
    SchedulerCounters counters_;
    MailboxCounters mailbox_counters_;
};

}  // namespace rtu::sim
