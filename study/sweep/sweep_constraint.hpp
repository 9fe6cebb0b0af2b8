#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "sim/config.hpp"

namespace rtu::study {

/// A condition on a machine, as a sweep file writes it: two sums compared by <, <=, >, >=, == or !=. A sum is
/// made of configuration keys, whole numbers, + - * / (of real numbers) and parentheses. A key that holds a
/// name may only stand alone, and be compared by == or != with a name in quotes: rtu.pair.mode == 'single'.
class SweepConstraint {
  public:
    /// Throws Error for anything else; `place` begins its text.
    SweepConstraint(std::string_view text, const std::string& place);

    /// False also when a side is no number, because of a division by zero.
    [[nodiscard]] bool holds(const sim::Config& config) const { return condition_(config); }

  private:
    std::function<bool(const sim::Config&)> condition_;
};

}  // namespace rtu::study
