#pragma once

#include <string>
#include <vector>

#include "study/validate/validate_report.hpp"

namespace rtu::study {

/// How the machine that is validated differs from the preset `default`: what the RTL reference has instead.
[[nodiscard]] std::vector<std::string> validated_machine();

/// The machines of a validation: each differs from validated_machine() in one or two resources.
[[nodiscard]] std::vector<ValidateConfig> validate_configs();

}  // namespace rtu::study
