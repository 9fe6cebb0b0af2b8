#pragma once

#include <string>
#include <vector>

#include "study/validate/validate_report.hpp"

namespace rtu::study {

/// How the machine that is validated differs from the preset `default`: what the RTL reference has instead.
[[nodiscard]] std::vector<std::string> validated_machine();

/// The machines of a validation: each differs from validated_machine() in one or two resources.
[[nodiscard]] std::vector<ValidateConfig> validate_configs();

/// A machine with `sim_sets`, "key=value" each, which the simulator takes and the RTL does not: what that
/// does to the cycles tells what a number is worth. Throws Error as sim::load_config() does, and for keys of
/// the tree, which is the same in both.
[[nodiscard]] sim::Config simulated_instead(const ValidateConfig& config,
                                            const std::vector<std::string>& sim_sets);

}  // namespace rtu::study
