#pragma once

#include <unordered_map>
#include <vector>

#include "sim/machine_observer.hpp"
#include "study/timeline/timeline.hpp"

namespace rtu::study {

/// Watches a machine and notes what happens in a window. What a ray waits for is told from the channels that
/// its token goes through, so no unit knows of it.
class TimelineRecorder final : public sim::MachineObserver {
  public:
    explicit TimelineRecorder(const TimelineWindow& window);

    void attach(const sim::MachineView& machine) override;
    void after(sim::Cycle begin, sim::Cycle end) override;
    /// Ends what is still open, once the run is over. `run_cycles`: its cycles.
    [[nodiscard]] Timeline finish(sim::Cycle run_cycles);

  private:
    struct Unit {
        const sim::ClockedUnit* unit = nullptr;
        sim::CycleAccount before;
        sim::Activity activity = sim::Activity::Waiting;
        bool has_worked = false;
        sim::Cycle since = 0;
    };
    struct Slot {
        bool is_used = false;
        std::uint32_t ray = 0;
        SlotWait wait = SlotWait::Scheduler;
        sim::Cycle accepted = 0, since = 0;
        RequestSpan request;  // the read under way
    };
    struct Rtu {
        const sim::RtuView view;
        std::vector<Slot> slots;
        std::unordered_map<std::uint32_t, std::uint32_t> slot_of;  // ray
        std::uint64_t accepted = 0;
        std::unordered_map<std::uint64_t, RequestSpan> misses;  // under way, by address
    };
    struct Channel {
        const sim::ChannelView* view = nullptr;
        ChannelSample last;
        bool is_known = false;
    };

    template <class Span>
    void add(std::vector<Span>& spans, Span span) const;
    void add_write(const RequestSpan& write);
    void watch_units(sim::Cycle begin);
    void close(std::uint32_t unit, sim::Cycle end, bool is_last);
    void watch_channels(sim::Cycle begin, sim::Cycle end);
    void watch_rtu(std::uint32_t index, sim::Cycle now);
    void watch_replies(std::uint32_t index, sim::Cycle now);
    void watch_requests(std::uint32_t index, sim::Cycle now);
    void watch_misses(std::uint32_t index, sim::Cycle now);
    void watch_hits(std::uint32_t index, sim::Cycle now);
    void accept(std::uint32_t index, sim::Cycle now);
    void wait_for(std::uint32_t index, std::uint32_t slot, SlotWait wait, sim::Cycle now);

    Timeline timeline_;
    TimelineWindow window_;
    std::vector<Unit> units_;
    std::vector<Rtu> rtus_;
    std::vector<Channel> channels_;
};

}  // namespace rtu::study
