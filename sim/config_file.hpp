#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/effective_config.hpp"

// A configuration file is TOML. Keys nest as the table of keys says, in tables or dotted; a value is plain or
// has its source with it:
//   clock_mhz = 1000
//   [rtu.box]
//   boxes_per_cycle = { value = 12, source = "where it was published" }

namespace rtu::sim {

/// The statements in `text`, in the order of their lines. `file` is the name in errors. Throws Error for text
/// that is not TOML (a repeated key included) and for values that no key can have.
[[nodiscard]] std::vector<ConfigAssignment> parse_config_toml(std::string_view text, const std::string& file);

/// Throws Error, naming the line, for a line that is longer than any in a file of settings: a dotted key
/// nests a table for every second character, and the parser destroys tables recursively.
void check_line_lengths(std::string_view text, const std::string& file);

/// The statements of a file. Throws Error when it cannot be read or is larger than any configuration.
[[nodiscard]] std::vector<ConfigAssignment> read_config_file(const std::filesystem::path& path);

}  // namespace rtu::sim
