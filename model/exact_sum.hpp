#pragma once

#include <array>
#include <cstddef>

namespace rtu::model {

/// The exact sum of N doubles as a non-overlapping expansion [SHE97]: components of growing magnitude whose
/// sum is the sum of the summands, without rounding. Summands may have any sign and size as long as no
/// partial sum overflows.
template <std::size_t N>
class ExactSum {
  public:
    explicit ExactSum(const std::array<double, N>& summands) {
        for (std::size_t length = 0; length < N; ++length) {
            double carry = summands[length];
            for (std::size_t i = 0; i < length; ++i) {
                const double sum = carry + components_[i];
                const double b_part = sum - carry;
                const double a_part = sum - b_part;
                components_[i] = (carry - a_part) + (components_[i] - b_part);
                carry = sum;
            }
            components_[length] = carry;
        }
    }
    /// The sum rounded to a double, to within an ulp: it has the exact sign, and is zero only if the sum is.
    [[nodiscard]] double value() const {
        double sum = 0;
        for (const double component : components_) sum += component;
        return sum;
    }

  private:
    std::array<double, N> components_{};
};

}  // namespace rtu::model
