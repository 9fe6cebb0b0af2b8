#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace rtu::apps {

/// Adds `rtusim methods`; when it is given, `command` does it.
void add_methods_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
