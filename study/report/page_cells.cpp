#include "study/report/page_cells.hpp"

#include <algorithm>

namespace rtu::study {

PageCell cell_of(std::optional<double> value) {
    PageCell cell;
    if (value) cell = *value;
    return cell;
}

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t((values.size() - 1) / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace rtu::study
