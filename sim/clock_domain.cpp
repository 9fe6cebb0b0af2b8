#include "sim/clock_domain.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "model/error.hpp"

namespace rtu::sim {

namespace {

// Cycles per kernel activation in fast mode: enough to make the kernel's share negligible.
constexpr Cycle batch_cycles = 64;

// Cycles between two words on how far the run is: some milliseconds of host time.
constexpr Cycle told_every_cycles = 1 << 16;

const sc_core::sc_time& period() {
    static const sc_core::sc_time one(1, sc_core::SC_NS);
    return one;
}

}  // namespace

ClockedUnit::ClockedUnit(sc_core::sc_module_name name, ClockDomain& domain)
    : sc_core::sc_module(name), domain_(domain) {
    SC_HAS_PROCESS(ClockedUnit);
    domain.add(*this);
    if (domain.mode() == ClockMode::Verify) {
        SC_METHOD(on_clock);
        sensitive << domain.clock_->posedge_event();
        dont_initialize();
    }
}

void ClockedUnit::on_clock() {
    domain_.guard([this] { step(domain_.now_); });
}

ClockDomain::ClockDomain(sc_core::sc_module_name name, ClockMode mode, Cycle watchdog_cycles)
    : sc_core::sc_module(name), mode_(mode), watchdog_cycles_(watchdog_cycles) {
    SC_HAS_PROCESS(ClockDomain);
    if (mode == ClockMode::Fast) {
        SC_METHOD(run_batch);
        sensitive << next_batch_;
    } else {
        clock_ = std::make_unique<sc_core::sc_clock>("clock", period());
        SC_METHOD(end_of_cycle);
        sensitive << clock_->negedge_event();
        dont_initialize();
    }
}

ClockDomain::~ClockDomain() = default;

Cycle ClockDomain::run(std::function<bool()> is_done, std::function<void()> on_batch) {
    is_done_ = std::move(is_done);
    on_batch_ = std::move(on_batch);
    if (has_started_ && mode_ == ClockMode::Fast) next_batch_.notify(sc_core::SC_ZERO_TIME);
    has_started_ = true;
    sc_core::sc_start();
    if (failure_) std::rethrow_exception(failure_);
    return now_;
}

// The kernel turns an exception that leaves a process into a report of its own; keep the original instead.
void ClockDomain::guard(const std::function<void()>& body) {
    try {
        body();
    } catch (...) {
        if (!failure_) failure_ = std::current_exception();
        sc_core::sc_pause();
    }
}

void ClockDomain::run_batch() {
    guard([this] { tick_batch(); });
}

void ClockDomain::tick_batch() {
    const Cycle start = now_;
    const Cycle end = start + batch_cycles;
    while (now_ < end) {
        for (ClockedUnit* unit : units_) unit->step(now_);
        if (observer_ != nullptr) observer_->after(now_, now_ + 1);
        if (is_done_()) {
            ++now_;
            sc_core::sc_pause();
            return;
        }
        const Cycle next = items_ == 0 ? next_cycle() : now_ + 1;
        if (next > now_ + 1) {
            if (next == no_cycle) fail();
            for (ClockedUnit* unit : units_) unit->skip(now_, next - now_ - 1);
            if (observer_ != nullptr) observer_->after(now_ + 1, next);
        }
        now_ = next;
    }
    watch();
    next_batch_.notify(sc_core::sc_time::from_value(period().value() * (now_ - start)));
}

void ClockDomain::end_of_cycle() {
    guard([this] {
        if (observer_ != nullptr) observer_->after(now_, now_ + 1);
        ++now_;
        if (is_done_()) {
            sc_core::sc_pause();
        } else {
            watch();
        }
    });
}

Cycle ClockDomain::next_cycle() const {
    Cycle next = no_cycle;
    for (const ClockedUnit* unit : units_) next = std::min(next, unit->next_event(now_));
    return next;
}

void ClockDomain::watch() {
    if (on_batch_ && now_ - told_cycle_ >= told_every_cycles) {
        told_cycle_ = now_;
        on_batch_();
    }
    if (pushes_ != watched_pushes_) {
        watched_pushes_ = pushes_;
        watched_cycle_ = now_;
    } else if (now_ - watched_cycle_ >= watchdog_cycles_) {
        fail();
    }
}

void ClockDomain::fail() const {
    std::string text =
        fmt::format("no progress: nothing moved since cycle {} (now {})", watched_cycle_, now_);
    for (const ClockedUnit* unit : units_) text += fmt::format("\n  {}: {}", unit->name(), unit->describe());
    throw std::logic_error(text);
}

}  // namespace rtu::sim
