#pragma once

#include <span>

#include "study/sweep/sweep_chart.hpp"
#include "study/toml_reader.hpp"

namespace rtu::study {

/// Reads one table of `charts`. Throws Error, with file and line, for what is no chart, and for a name that
/// one of `others` has.
[[nodiscard]] SweepChart parse_sweep_chart(const TomlReader& reader, const toml::table& table,
                                           std::span<const SweepChart> others);

}  // namespace rtu::study
