#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace rtu::apps {

/// Adds `rtusim trace` with its commands record, replay, info, verify and convert; as add_run_command().
void add_trace_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
