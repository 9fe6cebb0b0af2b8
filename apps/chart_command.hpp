#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace rtu::apps {

/// Adds `rtusim chart` to the command line; parsing it sets `command` to what then is to be called, which
/// returns the exit code and throws as the studies do whose charts are wanted.
void add_chart_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
