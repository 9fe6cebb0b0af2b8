#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "sim/cycle.hpp"

namespace rtu::sim {

/// A fixed-latency pipeline: what enters in cycle c can leave from cycle c + latency on, in order. Readiness
/// is a time stamp, so an item that cannot leave waits without cost. Bounded by `depth` items; the unit
/// checks `is_full`.
template <class T>
class Pipeline {
  public:
    Pipeline(std::uint32_t latency_cycles, std::size_t depth)
        : latency_cycles_(latency_cycles), depth_(depth) {
        std::size_t size = 1;
        while (size < depth) size *= 2;
        items_.resize(size);
        mask_ = size - 1;
    }
    [[nodiscard]] bool is_full() const { return tail_ - head_ >= depth_; }
    [[nodiscard]] bool is_empty() const { return tail_ == head_; }
    [[nodiscard]] bool is_ready(Cycle now) const { return !is_empty() && items_[head_ & mask_].first <= now; }
    [[nodiscard]] std::size_t size() const { return tail_ - head_; }
    /// When the oldest item can leave; no_cycle when empty.
    [[nodiscard]] Cycle ready_at() const { return is_empty() ? no_cycle : items_[head_ & mask_].first; }
    void push(Cycle now, const T& item) { items_[tail_++ & mask_] = {now + latency_cycles_, item}; }
    T pop() { return items_[head_++ & mask_].second; }
    [[nodiscard]] const T& front() const { return items_[head_ & mask_].second; }

  private:
    std::vector<std::pair<Cycle, T>> items_;
    std::uint32_t latency_cycles_;
    std::size_t depth_;
    std::size_t mask_ = 0;
    std::size_t head_ = 0, tail_ = 0;
};

}  // namespace rtu::sim
