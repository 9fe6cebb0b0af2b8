#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/clocked_unit.hpp"
#include "sim/fifo.hpp"
#include "sim/memory_message.hpp"
#include "sim/pipeline.hpp"

namespace rtu::test {

using sim::Activity;
using sim::ClockDomain;
using sim::ClockedUnit;
using sim::Cycle;
using sim::Fifo;
using sim::no_cycle;

/// What entered or left a channel, and the cycle in which it did.
template <class T>
struct Stamped {
    Cycle cycle = 0;
    T item{};
    friend bool operator==(const Stamped&, const Stamped&) = default;
};

/// Pushes a script of items, each in its cycle or as soon after as the channel has room, in order.
template <class T>
class MockSource final : public ClockedUnit {
  public:
    MockSource(sc_core::sc_module_name name, ClockDomain& domain, std::vector<Stamped<T>> script)
        : ClockedUnit(name, domain), script_(std::move(script)) {}

    sc_core::sc_port<sim::PushIf<T>> out{"out"};

    /// [item]: the cycle in which it was pushed.
    [[nodiscard]] const std::vector<Cycle>& pushed() const { return pushed_; }
    [[nodiscard]] bool is_done() const { return pushed_.size() == script_.size(); }
    [[nodiscard]] Cycle next_event(Cycle now) const override {
        return is_done() ? no_cycle : std::max(now + 1, script_[pushed_.size()].cycle);
    }
    [[nodiscard]] std::string describe() const override {
        return fmt::format("{} of {} pushed", pushed_.size(), script_.size());
    }

  protected:
    Activity tick(Cycle now) override {
        Activity activity = Activity::Waiting;
        while (!is_done() && script_[pushed_.size()].cycle <= now) {
            if (!out->can_push(now)) return activity == Activity::Busy ? activity : Activity::Blocked;
            out->push(now, script_[pushed_.size()].item);
            pushed_.push_back(now);
            activity = Activity::Busy;
        }
        return activity;
    }

  private:
    std::vector<Stamped<T>> script_;
    std::vector<Cycle> pushed_;
};

/// Takes whatever arrives, in the cycles in which it is open: always, unless told otherwise.
template <class T>
class MockSink final : public ClockedUnit {
  public:
    MockSink(sc_core::sc_module_name name, ClockDomain& domain, std::function<bool(Cycle)> is_open = {})
        : ClockedUnit(name, domain), is_open_(std::move(is_open)) {}

    sc_core::sc_port<Fifo<T>> in{"in"};

    [[nodiscard]] const std::vector<Stamped<T>>& received() const { return received_; }
    [[nodiscard]] Cycle next_event(Cycle /*now*/) const override { return no_cycle; }
    [[nodiscard]] std::string describe() const override {
        return fmt::format("{} received", received_.size());
    }

  protected:
    Activity tick(Cycle now) override {
        if (!in->can_pop(now)) return Activity::Waiting;
        if (is_open_ && !is_open_(now)) return Activity::Blocked;
        while (in->can_pop(now)) received_.push_back({now, in->pop(now)});
        return Activity::Busy;
    }

  private:
    std::function<bool(Cycle)> is_open_;
    std::vector<Stamped<T>> received_;
};

/// A memory of fixed latency that takes all that comes (up to 4096 reads in flight): answers reads
/// `latency_cycles` after it saw them, swallows writes, and keeps a record of all.
class MockMemory final : public ClockedUnit {
  public:
    MockMemory(sc_core::sc_module_name name, ClockDomain& domain, std::uint32_t latency_cycles)
        : ClockedUnit(name, domain), pipeline_(latency_cycles, 4096) {}

    sc_core::sc_port<Fifo<sim::MemoryRequest>> in{"in"};
    sc_core::sc_port<sim::PushIf<sim::MemoryReply>> out{"out"};

    [[nodiscard]] const std::vector<Stamped<sim::MemoryRequest>>& requests() const { return requests_; }
    [[nodiscard]] Cycle next_event(Cycle now) const override {
        return std::max(now + 1, pipeline_.ready_at());
    }
    [[nodiscard]] std::string describe() const override {
        return fmt::format("{} in flight", pipeline_.size());
    }

  protected:
    Activity tick(Cycle now) override {
        Activity activity = Activity::Waiting;
        while (pipeline_.is_ready(now) && out->can_push(now)) {
            out->push(now, pipeline_.pop());
            activity = Activity::Busy;
        }
        while (in->can_pop(now) && !pipeline_.is_full()) {
            const sim::MemoryRequest request = in->pop(now);
            requests_.push_back({now, request});
            if (!request.is_write) pipeline_.push(now, {request.address, request.tag});
            activity = Activity::Busy;
        }
        return activity;
    }

  private:
    sim::Pipeline<sim::MemoryReply> pipeline_;
    std::vector<Stamped<sim::MemoryRequest>> requests_;
};

}  // namespace rtu::test
