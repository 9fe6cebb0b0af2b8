#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "rtl_ref/harness/clock.hpp"

namespace rtu::rtl {

/// When the two sides of a unit are willing, cycle by cycle.
struct AlwaysWilling {
    bool offers() { return true; }
    bool takes() { return true; }
};

/// Cycles that a stream of vectors took.
struct StreamCycles {
    std::uint64_t first_result = 0;  ///< from the cycle that accepted the first vector to that of its result
    std::uint64_t total = 0;  ///< from the cycle that accepted the first vector to that of the last result
};

/// Sends `count` vectors through a unit between two valid/ready streams. Per vector, in order: `make()`
/// returns it, `drive(unit, vector)` sets the inputs, `check(unit, vector, cycles)` sees the outputs that
/// belong to it, `cycles` after it was accepted. An input that was offered stays until it is accepted.
/// Returns nothing if a result is missing: none for `patience` cycles.
template <class Unit, class Make, class Drive, class Check, class Willing = AlwaysWilling>
std::optional<StreamCycles> run_stream(Unit& unit, std::uint64_t count, Make make, Drive drive, Check check,
                                       Willing willing = {}, std::uint64_t patience = 10'000) {
    using Vector = decltype(make());
    struct UnderWay {
        Vector vector;
        std::uint64_t accepted;
    };
    std::deque<UnderWay> under_way;
    std::uint64_t accepted = 0, retired = 0, cycle = 0, first_accepted = 0, last_progress = 0;
    StreamCycles cycles;
    reset(unit);
    bool is_offered = false;
    while (retired < count) {
        if (!is_offered && accepted < count && willing.offers()) {
            under_way.push_back({make(), 0});
            drive(unit, under_way.back().vector);
            is_offered = true;
        }
        unit.valid_i = is_offered;
        unit.ready_i = willing.takes();
        settle(unit);
        if (is_offered && unit.ready_o) {
            if (accepted++ == 0) first_accepted = cycle;
            under_way.back().accepted = cycle;
            is_offered = false;
            last_progress = cycle;
        }
        if (unit.valid_o && unit.ready_i) {
            if (retired == accepted) return std::nullopt;  // a result that nobody asked for
            check(unit, under_way.front().vector, cycle - under_way.front().accepted);
            under_way.pop_front();
            if (retired++ == 0) cycles.first_result = cycle - first_accepted;
            last_progress = cycle;
        }
        if (cycle - last_progress > patience) return std::nullopt;
        clock_edge(unit);
        ++cycle;
    }
    cycles.total = cycle - 1 - first_accepted;
    return cycles;
}

}  // namespace rtu::rtl
