#pragma once

#include <string>

#include "study/report/run_report.hpp"

namespace rtu::study {

/// Of a run over a host link: transfers, bytes, rates, and where the time went. Empty without a link.
[[nodiscard]] std::string link_section(const SceneReport& report);

}  // namespace rtu::study
