#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rtu::study {

enum class ChartFormat : std::uint8_t { Svg, Png };

/// Throws Error, naming the package, when gnuplot is not on the PATH.
void check_gnuplot();

/// What gnuplot, a child process without a shell, draws for a script: the bytes of a file. `name` is the
/// chart's, for errors. The same bytes for the same script and gnuplot. Throws Error when gnuplot is missing
/// or fails.
[[nodiscard]] std::string run_gnuplot_script(std::string_view script, std::string_view name);

}  // namespace rtu::study
