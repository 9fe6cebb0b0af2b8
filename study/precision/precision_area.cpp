#include "study/precision/precision_area.hpp"

namespace rtu::study {
namespace {

constexpr double adder = 0.3, divider = 8;  // of a binary32 multiplier; assumed

double relative_significand(model::methods::NumberFormat format) { return (format.mantissa_bits + 1) / 24.0; }

}  // namespace

double area_proxy(const model::methods::OperationCounts& operations, model::methods::NumberFormat format) {
    const double p = relative_significand(format);
    return (operations.mul + divider * operations.div) * p * p + adder * operations.add * p;
}

double area_proxy(const model::methods::FilterOperations& operations, model::methods::NumberFormat format) {
    model::methods::OperationCounts narrow;
    narrow.mul = operations.narrow_mul;
    narrow.add = operations.narrow_add;
    return adder * operations.wide_add + area_proxy(narrow, format);
}

}  // namespace rtu::study
