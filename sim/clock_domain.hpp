#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <systemc>
#include <vector>

#include "sim/clocked_unit.hpp"
#include "sim/cycle.hpp"

namespace rtu::sim {

/// How a domain's units are run. Both give the same cycles and counters; a test holds them together.
enum class ClockMode : std::uint8_t {
    Fast,    ///< one process ticks all units, many cycles per activation, and jumps over all-idle stretches
    Verify,  ///< every unit has its own SC_METHOD on one sc_clock
};

/// Looks on while a domain runs. Everything in the domain may be read, and nothing changed.
class CycleObserver {
  public:
    virtual ~CycleObserver() = default;
    /// Told after every cycle, and after every stretch in which no channel held anything: in all cycles of
    /// [begin, end) each unit did one thing.
    virtual void after(Cycle begin, Cycle end) = 0;
};

/// The clock of a group of units. Build it first, then channels and units (units add themselves), then `run`.
class ClockDomain final : public sc_core::sc_module {
  public:
    /// `watchdog_cycles`: cycles without any channel traffic after which the run fails.
    ClockDomain(sc_core::sc_module_name name, ClockMode mode, Cycle watchdog_cycles);
    ~ClockDomain() override;

    /// Simulates until `is_done()` holds at the end of a cycle; returns the number of cycles simulated so
    /// far. Called again, it goes on from there. `on_batch()` is called now and then, to tell how far it is.
    /// Throws std::logic_error with every unit's state when nothing moves for `watchdog_cycles`.
    Cycle run(std::function<bool()> is_done, std::function<void()> on_batch = {});

    /// From now on `observer` is told of every cycle; it must outlive the run.
    void observe(CycleObserver& observer) { observer_ = &observer; }
    /// Every unit, in the order in which they were made.
    [[nodiscard]] const std::vector<ClockedUnit*>& units() const { return units_; }

    void note_push() { ++items_, ++pushes_; }
    void note_pop() { --items_; }
    [[nodiscard]] ClockMode mode() const { return mode_; }

  private:
    friend class ClockedUnit;
    void add(ClockedUnit& unit) { units_.push_back(&unit); }
    void guard(const std::function<void()>& body);
    void run_batch();     // the process of Fast
    void end_of_cycle();  // the process of Verify that ends the run
    void tick_batch();
    [[nodiscard]] Cycle next_cycle() const;
    void watch();
    [[noreturn]] void fail() const;

    ClockMode mode_;
    Cycle watchdog_cycles_;
    std::vector<ClockedUnit*> units_;
    std::function<bool()> is_done_;
    std::function<void()> on_batch_;
    CycleObserver* observer_ = nullptr;
    sc_core::sc_event next_batch_;
    std::unique_ptr<sc_core::sc_clock> clock_;
    std::exception_ptr failure_;
    bool has_started_ = false;
    Cycle now_ = 0;
    std::uint64_t items_ = 0;   // in all channels
    std::uint64_t pushes_ = 0;  // ever
    std::uint64_t watched_pushes_ = 0;
    Cycle watched_cycle_ = 0;
    Cycle told_cycle_ = 0;
};

}  // namespace rtu::sim
