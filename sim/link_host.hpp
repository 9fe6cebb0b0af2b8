#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "sim/clocked_unit.hpp"
#include "sim/config.hpp"
#include "sim/fifo.hpp"
#include "sim/link_message.hpp"
#include "sim/link_timeline.hpp"
#include "sim/memory_message.hpp"

namespace rtu::sim {

/// The batches that a host sends, one after another.
class BatchSupply {
  public:
    BatchSupply() = default;
    BatchSupply(const BatchSupply&) = delete;
    BatchSupply& operator=(const BatchSupply&) = delete;
    virtual ~BatchSupply() = default;
    /// The next batch; nothing after the last.
    [[nodiscard]] virtual std::optional<LinkBatch> next_batch() = 0;
};

/// The host: keeps up to `buffers` batches under way. It sends a batch up, and when the machine has finished
/// the batch's items it reads the results back; then the batch's place in the machine is free again.
/// Read-backs go before new batches. The machine's word that items are finished reaches it like any channel's
/// item; what that costs a real host is part of a transfer's overhead.
class LinkHost final : public ClockedUnit {
  public:
    LinkHost(sc_core::sc_module_name name, ClockDomain& domain, const Config::Link& config,
             BatchSupply& batches, LinkTimeline& timeline);

    sc_core::sc_port<PushIf<MemoryRequest>> transfers_out{"transfers_out"};
    sc_core::sc_port<Fifo<MemoryReply>> replies_in{"replies_in"};
    sc_core::sc_port<Fifo<ItemsFinished>> finished_in{"finished_in"};

    /// True when every batch has been sent and all results are back.
    [[nodiscard]] bool is_done() const { return !next_batch_ && under_way_ == 0; }
    /// Batches whose results are back.
    [[nodiscard]] std::uint64_t batch_count() const { return completed_; }
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;

  protected:
    Activity tick(Cycle now) override;

  private:
    struct Sent {
        std::uint64_t index = 0;
        std::uint64_t last_item = 0;  // finished when this many items are
        std::uint32_t down_bytes = 0;
    };

    [[nodiscard]] bool take_replies(Cycle now);
    [[nodiscard]] bool take_finished(Cycle now);
    [[nodiscard]] bool push_transfers(Cycle now);
    void send_batch(Cycle now);
    void complete_batch();
    [[nodiscard]] bool can_send() const { return next_batch_ && under_way_ < buffers_; }

    BatchSupply& batches_;
    LinkTimeline& timeline_;
    std::uint32_t buffers_;
    std::optional<LinkBatch> next_batch_;
    std::deque<Sent> sent_;     // until the machine has finished them
    std::deque<Sent> to_read_;  // until their read-back has been sent for
    std::deque<Sent> reading_;  // until it has arrived
    std::uint64_t sent_items_ = 0, finished_items_ = 0;
    std::uint64_t sent_batches_ = 0, completed_ = 0;
    std::uint32_t under_way_ = 0;
};

}  // namespace rtu::sim
