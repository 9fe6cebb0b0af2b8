#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <systemc>
#include <tlm>
#include <vector>

#include "sim/fifo.hpp"
#include "sim/memory_message.hpp"

// The boundary between an RTU and the memory that all share, as a pair of TLM-2.0 sockets (base protocol,
// non-blocking). A read: BEGIN_REQ, answered at once with END_REQ; BEGIN_RESP, answered at once with
// TLM_COMPLETED. A write is posted: BEGIN_REQ is answered with TLM_COMPLETED.
//
// Both ends add no cycle: what is pushed on one side lies in the registered channel on the other side. Room
// is a property of that channel too, and no phase of the protocol tells it, so each end is told at
// elaboration where to ask (connect). Kernel time stands still while a clock domain runs a batch of cycles:
// the cycle travels in the payload's extension, and the delay argument is zero. Payloads move no data: the
// model's memory is read by transport_dbg only.

namespace rtu::sim {

/// What a payload carries beside address and length.
struct BoundaryExtension final : tlm::tlm_extension<BoundaryExtension> {
    Cycle cycle = 0;  ///< of the call
    std::uint32_t tag = 0;
    std::uint8_t source = 0;

    [[nodiscard]] tlm::tlm_extension_base* clone() const override { return new BoundaryExtension(*this); }
    void copy_from(const tlm::tlm_extension_base& other) override {
        *this = static_cast<const BoundaryExtension&>(other);
    }
};

/// Payloads with their extension, used again and again.
class PayloadPool final : public tlm::tlm_mm_interface {
  public:
    /// A payload with one reference held.
    [[nodiscard]] tlm::tlm_generic_payload& acquire();
    void free(tlm::tlm_generic_payload* payload) override { free_.push_back(payload); }

  private:
    std::vector<std::unique_ptr<tlm::tlm_generic_payload>> payloads_;
    std::vector<tlm::tlm_generic_payload*> free_;
};

class BoundaryTarget;

/// The RTU's end: takes requests as a channel would, and fills the L1.
class BoundaryInitiator final : public sc_core::sc_module, public PushIf<MemoryRequest> {
  public:
    explicit BoundaryInitiator(sc_core::sc_module_name name);

    tlm_utils::simple_initiator_socket<BoundaryInitiator> socket{"socket"};
    sc_core::sc_port<PushIf<MemoryReply>> replies_out{"replies_out"};

    [[nodiscard]] bool can_push(Cycle now) const override;
    void push(Cycle now, const MemoryRequest& request) override;

  private:
    friend void connect(BoundaryInitiator& initiator, BoundaryTarget& target);
    tlm::tlm_sync_enum receive_reply(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                     sc_core::sc_time& delay);

    PayloadPool pool_;
    BoundaryTarget* target_ = nullptr;
};

/// The shared memory's end: passes requests to the L2, and takes its replies as a channel would. Another
/// initiator may bind to the socket to read the image with transport_dbg; a request that it sends while the
/// channel is full is an error.
class BoundaryTarget final : public sc_core::sc_module, public PushIf<MemoryReply> {
  public:
    /// `image`: what transport_dbg reads, from address 0; it must outlive the module.
    BoundaryTarget(sc_core::sc_module_name name, std::span<const std::byte> image);

    tlm_utils::simple_target_socket<BoundaryTarget> socket{"socket"};
    sc_core::sc_port<PushIf<MemoryRequest>> requests_out{"requests_out"};

    [[nodiscard]] bool can_push(Cycle now) const override;
    void push(Cycle now, const MemoryReply& reply) override;

  private:
    friend class BoundaryInitiator;
    friend void connect(BoundaryInitiator& initiator, BoundaryTarget& target);
    tlm::tlm_sync_enum receive_request(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay);
    unsigned read_image(tlm::tlm_generic_payload& payload);

    std::span<const std::byte> image_;
    // Reads on their way below; the index is their tag there.
    std::vector<tlm::tlm_generic_payload*> reads_;
    std::vector<std::uint32_t> free_tags_;
    BoundaryInitiator* initiator_ = nullptr;
};

/// Binds the sockets and tells each end where the other one's channel has room.
void connect(BoundaryInitiator& initiator, BoundaryTarget& target);

}  // namespace rtu::sim
