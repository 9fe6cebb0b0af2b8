#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace rtu::apps {

/// Adds `rtusim stability`; when it is parsed, `command` is set to what runs it and returns the exit code.
void add_stability_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
