#pragma once

#include <string>
#include <systemc>

#include "sim/cycle.hpp"
#include "sim/cycle_account.hpp"

namespace rtu::sim {

class ClockDomain;

/// What a unit did in one cycle.
enum class Activity : std::uint8_t {
    Busy,     ///< it moved work forward
    Blocked,  ///< it had work and could not move it: a full channel or a structural hazard
    Waiting,  ///< it had nothing to move
};

/// Base of every unit. A unit is ticked once in every cycle of its domain, either by the domain's scheduler
/// or by its own SC_METHOD (see ClockDomain); it meets other units only through channels.
class ClockedUnit : public sc_core::sc_module {
  public:
    ClockedUnit(sc_core::sc_module_name name, ClockDomain& domain);

    /// Runs cycle `now` and accounts for it.
    void step(Cycle now) { account(tick(now), 1); }
    /// Accounts for the cycles after `now` in which the domain knew that nothing could begin or end.
    void skip(Cycle now, std::uint64_t cycles) { account(between_events(now), cycles); }

    /// The earliest cycle after `now` in which this unit acts although no channel holds anything; no_cycle
    /// when it waits for input.
    [[nodiscard]] virtual Cycle next_event(Cycle now) const = 0;
    /// One line for the watchdog: what the unit holds and what it waits for.
    [[nodiscard]] virtual std::string describe() const = 0;

    /// What the unit did in the cycles since it was last asked: of a range in which it did one thing only.
    [[nodiscard]] Activity activity_since(const CycleAccount& before) const {
        if (account_.busy != before.busy) return Activity::Busy;
        return account_.blocked != before.blocked ? Activity::Blocked : Activity::Waiting;
    }
    /// Cycles so far; waiting cycles after the last work count as idle.
    [[nodiscard]] CycleAccount cycle_account() const {
        CycleAccount result = account_;
        result.idle += pending_wait_;
        return result;
    }

  protected:
    /// One cycle, from the output end to the input end: retire, compute, accept.
    virtual Activity tick(Cycle now) = 0;
    /// What tick() would return in every cycle after `now` and before the next event of any unit. A unit
    /// whose work goes on by itself says Busy; its next_event() must then tell when the work ends.
    [[nodiscard]] virtual Activity between_events(Cycle /*now*/) const { return Activity::Waiting; }

  private:
    void on_clock();
    void account(Activity activity, std::uint64_t cycles) {
        if (activity == Activity::Waiting) {
            pending_wait_ += cycles;
            return;
        }
        (has_worked_ ? account_.starved : account_.idle) += pending_wait_;
        pending_wait_ = 0;
        has_worked_ = true;
        (activity == Activity::Busy ? account_.busy : account_.blocked) += cycles;
    }

    ClockDomain& domain_;
    CycleAccount account_;
    std::uint64_t pending_wait_ = 0;
    bool has_worked_ = false;
};

}  // namespace rtu::sim
