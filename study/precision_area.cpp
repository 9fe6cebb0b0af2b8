#include "study/precision_area.hpp"

namespace rtu::study {
namespace {

constexpr double adder = 0.3, divider = 8;  // of a binary32 multiplier; assumed

double relative_significand(model::methods::NumberFormat format) { return (format.mantissa_bits + 1) / 24.0; }

}  // namespace

double area_proxy(const TestOperations& operations, model::methods::NumberFormat format) {
    const double p = relative_significand(format);
    return (operations.mul + divider * operations.div) * p * p + adder * operations.add * p;
}

double area_proxy(const model::methods::FilterOperations& operations, model::methods::NumberFormat format) {
    const TestOperations narrow{double(operations.narrow_mul), double(operations.narrow_add), 0};
    return adder * operations.wide_add + area_proxy(narrow, format);
}

}  // namespace rtu::study
