#pragma once

#include <vector>

#include "study/sweep/sweep_file.hpp"
#include "study/toml_reader.hpp"

// The tables [set], [axes] and [[linked]] of a sweep file: keys of the machine, and what they are set to.

namespace rtu::study {

/// The statements of [set]: one value a key.
[[nodiscard]] std::vector<sim::ConfigAssignment> parse_settings(const TomlReader& reader,
                                                                const toml::table& table);

/// The axes of [axes], one a key, in the order of their lines. A value is a list, { from, to, step } or
/// { from, to, factor }: both ends belong to it when they are met, and products are rounded to whole numbers.
[[nodiscard]] std::vector<SweepAxis> parse_axes(const TomlReader& reader, const toml::table& table);

/// One table of [[linked]]: keys with lists of one length, which change together.
[[nodiscard]] SweepAxis parse_linked_axis(const TomlReader& reader, const toml::table& table);

/// Throws Error for a key that is set twice, naming both places.
void check_keys_once(const std::vector<sim::ConfigAssignment>& fixed, const std::vector<SweepAxis>& axes);

}  // namespace rtu::study
