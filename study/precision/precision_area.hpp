#pragma once

#include "model/methods/counted.hpp"
#include "model/methods/number_format.hpp"
#include "model/methods/quantised_filter.hpp"

namespace rtu::study {

/// What the arithmetic of a fully pipelined tester of those operations takes, in units of one binary32
/// multiplier. With p the bits of a significand, the implicit one included:
///     multiplier (p / 24)^2    adder 0.3 p / 24    divider 8 (p / 24)^2
/// A proxy: the ratios at p = 24 and both laws are assumed. Comparisons, exponents, registers and control are
/// left out.
[[nodiscard]] double area_proxy(const model::methods::OperationCounts& operations,
                                model::methods::NumberFormat format);

/// The same of a quantised filter whose multipliers have that format.
[[nodiscard]] double area_proxy(const model::methods::FilterOperations& operations,
                                model::methods::NumberFormat format);

}  // namespace rtu::study
