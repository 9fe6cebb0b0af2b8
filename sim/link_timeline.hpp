#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "model/error.hpp"
#include "sim/cycle.hpp"
#include "sim/link_counters.hpp"

namespace rtu::sim {

/// Watches what is under way and adds up where the time goes. It is told only, and asked at the end: no unit
/// decides by it. Within a cycle the order of what it is told does not matter.
class LinkTimeline {
  public:
    enum class Stage : std::uint8_t { Upload, Machine, ReadBack };

    /// From cycle `now` on one more thing is in that stage; cycles never decrease.
    void begin(Stage stage, Cycle now) {
        advance(now);
        ++under_way_[std::size_t(stage)];
    }
    /// From cycle `now` on one less is.
    void end(Stage stage, Cycle now) {
        advance(now);
        --under_way_[std::size_t(stage)];
    }
    /// All cycles before `end`. Throws std::logic_error when something is still under way.
    [[nodiscard]] LinkTime time_until(Cycle end) {
        advance(end);
        for (const std::int64_t count : under_way_)
            RTU_CHECK(count == 0, "{} things are still under way on the link", count);
        return time_;
    }

  private:
    [[nodiscard]] bool has(Stage stage) const { return under_way_[std::size_t(stage)] > 0; }
    void advance(Cycle now) {
        std::uint64_t& share = has(Stage::Machine)    ? time_.machine_cycles
                               : has(Stage::ReadBack) ? time_.read_back_cycles
                               : has(Stage::Upload)   ? time_.upload_cycles
                                                      : time_.waiting_cycles;
        share += now - last_;
        last_ = now;
    }

    std::array<std::int64_t, 3> under_way_{};  // below 0 only within a cycle
    LinkTime time_;
    Cycle last_ = 0;
};

}  // namespace rtu::sim
