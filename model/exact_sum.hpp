#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace rtu::model {

/// The exact sum of at most N doubles as an expansion [SHE97]: non-zero components of growing magnitude,
/// whose sum is that of the summands without rounding. Rounding to nearest even keeps them non-adjacent, so
/// that the largest outweighs the rest. Summands may have any sign and size as long as no partial sum
/// overflows.
template <std::size_t N>
class ExactSum {
  public:
    ExactSum() = default;
    explicit ExactSum(const std::array<double, N>& summands) {
        for (const double summand : summands) add(summand);
    }
    /// Requires fewer than N summands so far.
    void add(double summand) {
        double carry = summand;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const double sum = carry + components_[i];
            const double b_part = sum - carry;
            const double a_part = sum - b_part;
            const double error = (carry - a_part) + (components_[i] - b_part);
            if (error != 0) components_[kept++] = error;
            carry = sum;
        }
        if (carry != 0) components_[kept++] = carry;
        count_ = kept;
    }
    /// The sum rounded to a double, to within an ulp: it has the exact sign, and is zero only if the sum is.
    [[nodiscard]] double value() const {
        double sum = 0;
        for (std::size_t i = 0; i < count_; ++i) sum += components_[i];
        return sum;
    }
    [[nodiscard]] std::span<const double> components() const { return {components_.data(), count_}; }

  private:
    std::array<double, N> components_{};
    std::size_t count_ = 0;
};

}  // namespace rtu::model
