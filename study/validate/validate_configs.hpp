#pragma once

#include <string>
#include <vector>

#include "study/validate/validate_report.hpp"

namespace rtu::study {

/// How the machine that is validated differs from the preset `default`: what the RTL reference has instead.
[[nodiscard]] std::vector<std::string> validated_machine();

/// The machines of a validation: each differs from validated_machine() in one or two resources. The simulator
/// also takes `sim_sets`, "key=value" each, which the RTL does not: what that does to its cycles tells what
/// the number is worth. Throws Error as sim::load_config() does, and for keys of the tree, which is the same
/// in both.
[[nodiscard]] std::vector<ValidateConfig> validate_configs(const std::vector<std::string>& sim_sets = {});

}  // namespace rtu::study
