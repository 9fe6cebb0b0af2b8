#include "sim/memory_boundary.hpp"

#include <algorithm>
#include <cstring>

#include "model/error.hpp"

namespace rtu::sim {
namespace {

BoundaryExtension& extension(tlm::tlm_generic_payload& payload) {
    BoundaryExtension* found = payload.get_extension<BoundaryExtension>();
    RTU_CHECK(found != nullptr, "a payload at the memory boundary has no BoundaryExtension");
    return *found;
}

}  // namespace

tlm::tlm_generic_payload& PayloadPool::acquire() {
    if (free_.empty()) {
        payloads_.push_back(std::make_unique<tlm::tlm_generic_payload>(this));
        payloads_.back()->set_extension(new BoundaryExtension);  // the payload owns it
        free_.push_back(payloads_.back().get());
    }
    tlm::tlm_generic_payload& payload = *free_.back();
    free_.pop_back();
    payload.acquire();
    return payload;
}

BoundaryInitiator::BoundaryInitiator(sc_core::sc_module_name name) : sc_core::sc_module(name) {
    socket.register_nb_transport_bw(this, &BoundaryInitiator::receive_reply);
}

bool BoundaryInitiator::can_push(Cycle now) const { return target_->requests_out->can_push(now); }

void BoundaryInitiator::push(Cycle now, const MemoryRequest& request) {
    tlm::tlm_generic_payload& payload = pool_.acquire();
    payload.set_command(request.is_write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND);
    payload.set_address(request.address);
    payload.set_data_length(request.size_bytes);
    payload.set_streaming_width(request.size_bytes);
    payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
    BoundaryExtension& message = extension(payload);
    message.cycle = now;
    message.tag = request.tag;
    message.source = request.source;
    tlm::tlm_phase phase = tlm::BEGIN_REQ;
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    const tlm::tlm_sync_enum status = socket->nb_transport_fw(payload, phase, delay);
    if (status == tlm::TLM_COMPLETED) {
        payload.release();
    } else {
        RTU_CHECK(status == tlm::TLM_UPDATED && phase == tlm::END_REQ, "{}: the request was not taken",
                  name());
    }
}

tlm::tlm_sync_enum BoundaryInitiator::receive_reply(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                                    sc_core::sc_time& /*delay*/) {
    RTU_CHECK(phase == tlm::BEGIN_RESP && payload.is_response_ok(), "{}: unexpected response", name());
    const BoundaryExtension& message = extension(payload);
    replies_out->push(message.cycle, {payload.get_address(), message.tag});
    payload.release();
    return tlm::TLM_COMPLETED;
}

BoundaryTarget::BoundaryTarget(sc_core::sc_module_name name, std::span<const std::byte> image)
    : sc_core::sc_module(name), image_(image) {
    socket.register_nb_transport_fw(this, &BoundaryTarget::receive_request);
    socket.register_transport_dbg(this, &BoundaryTarget::read_image);
}

bool BoundaryTarget::can_push(Cycle now) const { return initiator_->replies_out->can_push(now); }

tlm::tlm_sync_enum BoundaryTarget::receive_request(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                                   sc_core::sc_time& /*delay*/) {
    RTU_CHECK(phase == tlm::BEGIN_REQ, "{}: unexpected phase", name());
    const BoundaryExtension& message = extension(payload);
    MemoryRequest request{.address = payload.get_address(),
                          .size_bytes = payload.get_data_length(),
                          .tag = 0,
                          .source = message.source,
                          .is_write = payload.is_write()};
    if (request.is_write) {
        requests_out->push(message.cycle, request);
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
        return tlm::TLM_COMPLETED;
    }
    if (free_tags_.empty()) {
        free_tags_.push_back(std::uint32_t(reads_.size()));
        reads_.push_back(nullptr);
    }
    request.tag = free_tags_.back();
    free_tags_.pop_back();
    reads_[request.tag] = &payload;
    requests_out->push(message.cycle, request);
    phase = tlm::END_REQ;
    return tlm::TLM_UPDATED;
}

void BoundaryTarget::push(Cycle now, const MemoryReply& reply) {
    tlm::tlm_generic_payload& payload = *reads_[reply.tag];
    free_tags_.push_back(reply.tag);
    extension(payload).cycle = now;
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
    tlm::tlm_phase phase = tlm::BEGIN_RESP;
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    const tlm::tlm_sync_enum status = socket->nb_transport_bw(payload, phase, delay);
    RTU_CHECK(status == tlm::TLM_COMPLETED, "{}: the response was not taken", name());
}

// Bytes beyond the image do not exist: the count says how many were read, none for a write.
unsigned BoundaryTarget::read_image(tlm::tlm_generic_payload& payload) {
    if (!payload.is_read() || payload.get_address() >= image_.size()) return 0;
    const std::size_t count =
        std::min<std::size_t>(payload.get_data_length(), image_.size() - payload.get_address());
    std::memcpy(payload.get_data_ptr(), image_.data() + payload.get_address(), count);
    return unsigned(count);
}

void connect(BoundaryInitiator& initiator, BoundaryTarget& target) {
    initiator.socket.bind(target.socket);
    initiator.target_ = &target;
    target.initiator_ = &initiator;
}

}  // namespace rtu::sim
