#pragma once

#include <string>
#include <vector>

#include "study/report/page_content.hpp"
#include "study/sweep/sweep_objective.hpp"

namespace rtu::study {

/// The rows of a sweep as columns, every one there is; `front` ("yes", "no") where the front is known.
struct PagePoints {
    std::string note;
    std::vector<SweepObjective> objectives;  ///< what the sweep looks for; empty: not known
    std::vector<PageField> fields;
};

/// What varies among the points, to be filtered and drawn; the fastest and slowest design; miss curves where
/// the size of a cache varies. Needs the column `mrps`.
[[nodiscard]] PageSection points_section(PagePoints points);

}  // namespace rtu::study
