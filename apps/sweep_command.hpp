#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace rtu::apps {

/// Adds `rtusim sweep`; as add_run_command().
void add_sweep_command(CLI::App& app, std::function<int()>& command);

/// Adds `rtusim sweep-worker`, which `rtusim sweep` and its tasks start and no help lists; as
/// add_run_command().
void add_sweep_worker_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
