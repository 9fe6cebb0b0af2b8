#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "mock_units.hpp"
#include "sim/kernel.hpp"
#include "sim/memory_boundary.hpp"

namespace rtu::test {
namespace {

using sim::ClockMode;
using sim::MemoryReply;
using sim::MemoryRequest;

struct BoundarySetup {
    bool has_boundary = true;  ///< else the channels are bound directly
    std::size_t channel_depth = 2;
    std::uint32_t memory_latency_cycles = 9;
    std::function<bool(Cycle)> is_sink_open{};
    ClockMode mode = ClockMode::Fast;
    bool is_reversed = false;
};

struct BoundaryOutcome {
    Cycle cycles = 0;
    std::vector<Cycle> pushed;
    std::vector<Stamped<MemoryReply>> received;
    std::vector<Cycle> requests_seen;
    friend bool operator==(const BoundaryOutcome&, const BoundaryOutcome&) = default;
};

constexpr std::uint32_t request_count = 200;

std::vector<Stamped<MemoryRequest>> script() {
    std::vector<Stamped<MemoryRequest>> items;
    for (std::uint32_t i = 0; i < request_count; ++i) {
        items.push_back({Cycle{i / 50} * 300, {std::uint64_t{i} * 64, 32, 1000 + i, 3, i % 7 == 6}});
    }
    return items;
}

BoundaryOutcome run(const BoundarySetup& setup) {
    sim::start_fresh_kernel();
    ClockDomain clock("clock", setup.mode, 10'000);
    Fifo<MemoryRequest> requests("requests", setup.channel_depth, clock);
    Fifo<MemoryReply> replies("replies", setup.channel_depth, clock);
    std::unique_ptr<MockMemory> memory;
    if (setup.is_reversed)
        memory = std::make_unique<MockMemory>("memory", clock, setup.memory_latency_cycles);
    MockSource<MemoryRequest> source("source", clock, script());
    MockSink<MemoryReply> sink("sink", clock, setup.is_sink_open);
    if (!memory) memory = std::make_unique<MockMemory>("memory", clock, setup.memory_latency_cycles);
    sim::BoundaryInitiator initiator("initiator");
    sim::BoundaryTarget target("target", {});
    sim::connect(initiator, target);
    initiator.replies_out(replies);
    target.requests_out(requests);
    memory->in(requests);
    sink.in(replies);
    if (setup.has_boundary) {
        source.out(initiator);
        memory->out(target);
    } else {
        source.out(requests);
        memory->out(replies);
    }
    BoundaryOutcome outcome;
    outcome.cycles = clock.run([&] {
        return source.is_done() && requests.size() == 0 && replies.size() == 0 &&
               memory->next_event(0) == no_cycle;
    });
    outcome.pushed = source.pushed();
    outcome.received = sink.received();
    for (const auto& request : memory->requests()) outcome.requests_seen.push_back(request.cycle);
    return outcome;
}

TEST(MemoryBoundary, BringsEveryReplyBackUnderTheTagOfItsRequest) {
    const BoundaryOutcome outcome = run({});
    std::vector<MemoryReply> expected, received;
    for (const auto& request : script()) {
        if (!request.item.is_write) expected.push_back({request.item.address, request.item.tag});
    }
    for (const auto& reply : outcome.received) received.push_back(reply.item);
    EXPECT_EQ(received, expected);
    EXPECT_EQ(outcome.requests_seen.size(), request_count);
}

TEST(MemoryBoundary, AddsNoCycleToTheChannelsItCrosses) {
    BoundarySetup setup;
    for (const bool is_slow : {false, true}) {
        if (is_slow) setup.is_sink_open = [](Cycle now) { return now % 4 == 0; };
        setup.has_boundary = true;
        const BoundaryOutcome through = run(setup);
        setup.has_boundary = false;
        EXPECT_EQ(through, run(setup));
    }
}

TEST(MemoryBoundary, DoesNotDependOnTheOrderOfUnitsOrTheClockMode) {
    BoundarySetup setup;
    const BoundaryOutcome forward = run(setup);
    setup.is_reversed = true;
    EXPECT_EQ(run(setup), forward);
    setup.mode = ClockMode::Verify;
    EXPECT_EQ(run(setup), forward);
}

struct DebugInitiator : sc_core::sc_module {
    explicit DebugInitiator(sc_core::sc_module_name name) : sc_core::sc_module(name) {}
    tlm_utils::simple_initiator_socket<DebugInitiator> socket{"socket"};
};

TEST(MemoryBoundary, LetsAnyInitiatorReadTheImage) {
    sim::start_fresh_kernel();
    ClockDomain clock("clock", ClockMode::Fast, 1000);
    std::array<std::byte, 100> image{};
    for (std::size_t i = 0; i < image.size(); ++i) image[i] = std::byte(i);
    DebugInitiator initiator("initiator");
    sim::BoundaryTarget target("target", image);
    Fifo<MemoryRequest> requests("requests", 2, clock);
    target.requests_out(requests);
    initiator.socket.bind(target.socket);
    std::array<unsigned char, 16> data{};
    const auto read_at = [&](std::uint64_t address, tlm::tlm_command command) {
        tlm::tlm_generic_payload payload;
        payload.set_command(command);
        payload.set_address(address);
        payload.set_data_ptr(data.data());
        payload.set_data_length(unsigned(data.size()));
        return initiator.socket->transport_dbg(payload);
    };
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
    EXPECT_EQ(read_at(40, tlm::TLM_READ_COMMAND), 16U);
    for (std::size_t i = 0; i < data.size(); ++i) EXPECT_EQ(data[i], 40 + i);
    EXPECT_EQ(read_at(92, tlm::TLM_READ_COMMAND), 8U);
    EXPECT_EQ(data[7], 99);
    EXPECT_EQ(read_at(100, tlm::TLM_READ_COMMAND), 0U);
    EXPECT_EQ(read_at(0, tlm::TLM_WRITE_COMMAND), 0U);
}

}  // namespace
}  // namespace rtu::test
