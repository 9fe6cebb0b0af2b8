#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace rtu::apps {

/// Adds `rtusim config` to the command line; parsing it sets `command` to what then is to be called, which
/// returns the exit code and throws Error for a preset, file or key that is not known.
void add_config_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
