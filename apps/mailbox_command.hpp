#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace rtu::apps {

/// Adds `rtusim mailbox` to the command line; parsing it sets `command` to what then is to be called, which
/// returns the exit code and throws as study::run_mailbox_study() does.
void add_mailbox_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
