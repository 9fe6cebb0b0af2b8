#pragma once

#include <CLI/CLI.hpp>

#include "apps/run_plan.hpp"

// The options of a run, in groups that the commands share.

namespace rtu::apps {

/// --pairing and --edge-identity.
void add_tree_options(CLI::App& command, RunArguments& arguments);
/// --workload, --resolution, --camera, --seed; excluded by `rays` when that is not null.
void add_picture_options(CLI::App& command, RunArguments& arguments, CLI::Option* rays);
/// --kind, --format and --force, for rays from a file; they need `rays` when that is not null.
void add_ray_input_options(CLI::App& command, RunArguments& arguments, CLI::Option* rays);
/// --json, --csv, --image, --check.
void add_output_options(CLI::App& command, RunArguments& arguments);
/// --fidelity and --tolerance.
void add_fidelity_options(CLI::App& command, RunArguments& arguments);
/// --clock-mode and --threads.
void add_host_options(CLI::App& command, RunArguments& arguments);

}  // namespace rtu::apps
