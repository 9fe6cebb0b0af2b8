#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace rtu::apps {

/// Adds `rtusim report`; as add_run_command().
void add_report_command(CLI::App& app, std::function<int()>& command);

}  // namespace rtu::apps
