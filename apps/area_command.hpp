#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace rtu::apps {

/// Adds `rtusim area` to the command line; parsing it sets `command` to what then is to be called, which
/// returns the exit code and throws as study::run_area_study() does.
void add_area_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
