#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/effective_config.hpp"

namespace rtu::apps {

/// The options that choose a machine; `run` and `config` share them.
struct MachineOptions {
    std::string preset = "default";
    std::string file;  ///< empty: none
    std::vector<std::string> sets;
    std::string link = "none";  ///< only of commands with --link
};

/// Refuses an empty text: an option whose shell variable is not set must not pass for one that is not given.
[[nodiscard]] CLI::Validator is_not_empty();

/// Adds --preset, --config and --set.
void add_machine_options(CLI::App& command, MachineOptions& options);

/// Adds --link: the host link in front of the machine.
void add_link_option(CLI::App& command, MachineOptions& options);

/// The machine that they describe; throws Error for anything unknown, repeated or out of range.
[[nodiscard]] sim::EffectiveConfig load(const MachineOptions& options);
/// The same behind another link.
[[nodiscard]] sim::EffectiveConfig load(const MachineOptions& options, const std::string& link);

}  // namespace rtu::apps
