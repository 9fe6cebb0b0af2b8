#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "apps/run_plan.hpp"

namespace rtu::apps {

/// Simulates what the arguments say, writes and prints the reports, and returns the exit code. Throws as
/// study::run_scene() does.
int run_scenes(const RunArguments& arguments);

/// Adds `rtusim run` to the command line; parsing it sets `command` to what then is to be called, which
/// returns the exit code and throws as study::run_scene() does.
void add_run_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
