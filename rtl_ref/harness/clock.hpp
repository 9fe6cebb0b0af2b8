#pragma once

namespace rtu::rtl {

/// Settles a Verilated unit's outputs for the inputs that were set; the clock is low.
template <class Unit>
void settle(Unit& unit) {
    unit.clk_i = 0;
    unit.eval();
}

/// The rising edge that ends a cycle.
template <class Unit>
void clock_edge(Unit& unit) {
    unit.clk_i = 1;
    unit.eval();
}

/// Resets a unit between two valid/ready streams and leaves both idle.
template <class Unit>
void reset(Unit& unit) {
    unit.valid_i = 0;
    unit.ready_i = 1;
    unit.rst_ni = 1;
    settle(unit);
    unit.rst_ni = 0;  // its falling edge clears what has an asynchronous reset
    settle(unit);
    clock_edge(unit);
    unit.rst_ni = 1;
    settle(unit);
}

}  // namespace rtu::rtl
