#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace rtu::apps {

/// Adds `rtusim timeline`; when it was typed, `command` becomes what to run.
void add_timeline_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
