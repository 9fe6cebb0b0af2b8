#pragma once

#include <cstddef>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include "model/error.hpp"
#include "sim/clock_domain.hpp"

namespace rtu::sim {

/// The writing end of a channel, for units whose output may also leave through a socket.
template <class T>
class PushIf : public sc_core::sc_interface {
  public:
    [[nodiscard]] virtual bool can_push(Cycle now) const = 0;
    virtual void push(Cycle now, const T& item) = 0;
};

/// What a channel does, for observers of a run, between cycles.
class ChannelView {
  public:
    virtual ~ChannelView() = default;
    [[nodiscard]] virtual std::size_t depth() const = 0;
    /// Items inside, visible or not.
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// Items that were pushed, and popped, in cycle `now`, the last one simulated.
    [[nodiscard]] virtual std::size_t pushed(Cycle now) const = 0;
    [[nodiscard]] virtual std::size_t popped(Cycle now) const = 0;
};

/// The only channel between units: registered and bounded, with one writer and one reader.
/// A push is visible to the reader in the next cycle, and a pop frees its entry for the writer in the next
/// cycle, so the order in which units are ticked cannot matter. There is no commit step: both ends compare
/// cycle stamps. Full rate needs depth >= 2.
template <class T>
class Fifo final : public sc_core::sc_object, public PushIf<T>, public ChannelView {
  public:
    Fifo(const char* name, std::size_t depth, ClockDomain& domain)
        : sc_core::sc_object(name), depth_(depth), domain_(domain) {
        std::size_t size = 1;
        while (size < depth) size *= 2;
        items_.resize(size);
        mask_ = size - 1;
    }

    [[nodiscard]] bool can_pop(Cycle now) const { return head_ != visible_tail(now); }
    [[nodiscard]] const T& front() const { return items_[head_ & mask_]; }
    T pop(Cycle now) {
        RTU_CHECK(can_pop(now), "{}: pop from an empty channel at cycle {}", name(), now);
        if (last_pop_ != now) {
            last_pop_ = now;
            head_at_start_ = head_;
        }
        domain_.note_pop();
        return std::move(items_[head_++ & mask_]);
    }

    [[nodiscard]] bool can_push(Cycle now) const override { return space(now) > 0; }
    /// Items that can still be pushed in this cycle.
    [[nodiscard]] std::size_t space(Cycle now) const {
        return depth_ - (tail_ - (last_pop_ == now ? head_at_start_ : head_));
    }
    void push(Cycle now, const T& item) override {
        RTU_CHECK(can_push(now), "{}: push to a full channel at cycle {}", name(), now);
        if (last_push_ != now) {
            last_push_ = now;
            tail_at_start_ = tail_;
        }
        domain_.note_push();
        items_[tail_++ & mask_] = item;
    }

    /// Items inside, visible or not: for state dumps and checks at the end, not for decisions within a cycle.
    [[nodiscard]] std::size_t size() const override { return tail_ - head_; }
    [[nodiscard]] std::size_t depth() const override { return depth_; }
    [[nodiscard]] std::size_t pushed(Cycle now) const override {
        return last_push_ == now ? tail_ - tail_at_start_ : 0;
    }
    [[nodiscard]] std::size_t popped(Cycle now) const override {
        return last_pop_ == now ? head_ - head_at_start_ : 0;
    }
    /// The item that was pushed as number `index` of cycle `now`, from 0.
    [[nodiscard]] const T& pushed_item(std::size_t index) const {
        return items_[(tail_at_start_ + index) & mask_];
    }
    [[nodiscard]] const char* kind() const override { return "rtu_fifo"; }

  private:
    [[nodiscard]] std::size_t visible_tail(Cycle now) const {
        return last_push_ == now ? tail_at_start_ : tail_;
    }

    std::vector<T> items_;
    std::size_t depth_;
    std::size_t mask_ = 0;
    std::size_t head_ = 0, tail_ = 0;  // running counts; the index is count & mask_
    std::size_t head_at_start_ = 0, tail_at_start_ = 0;
    Cycle last_push_ = no_cycle, last_pop_ = no_cycle;
    ClockDomain& domain_;
};

}  // namespace rtu::sim
