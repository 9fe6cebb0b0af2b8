#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "study/stability/stability_experiment.hpp"

namespace rtu::study {

/// One point of a case's parameter grid.
struct StabilitySetting {
    std::string parameter;  ///< "1e-3", "fan_128", "t_min = t"
    std::string aim;        ///< what rays are aimed at: "vertex"
    std::function<std::unique_ptr<Experiment>()> make;
    /// Shows what happens where the check does not apply; no failure of its case, and told by parameter only.
    bool is_comparison = false;
};

/// A way in which methods fail, and the grid on which it is looked for. Numbers 1 to 21 are those of
/// docs/stability.md.
struct StabilityCase {
    int number = 0;
    std::string name;  ///< as on the command line
    std::string title;
    std::string check;                       ///< what must hold
    std::vector<StabilitySetting> settings;  ///< empty: the case is not about a method, `check` says why
};

/// All cases, by number.
[[nodiscard]] std::vector<StabilityCase> stability_cases();

/// The parts of which stability_cases() is made: about surfaces, about single triangles, and about a method's
/// agreement with itself.
[[nodiscard]] std::vector<StabilityCase> surface_cases();
[[nodiscard]] std::vector<StabilityCase> triangle_cases();
[[nodiscard]] std::vector<StabilityCase> consistency_cases();

}  // namespace rtu::study
