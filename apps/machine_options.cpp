#include "apps/machine_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/presets.hpp"

namespace rtu::apps {

CLI::Validator is_not_empty() {
    return {[](const std::string& text) { return text.empty() ? "expected a name, got ''" : ""; }, ""};
}

void add_machine_options(CLI::App& command, MachineOptions& options) {
    command
        .add_option("--preset", options.preset,
                    fmt::format("the machine to start from: {}", fmt::join(sim::preset_names(), ", ")))
        ->type_name("NAME")
        ->capture_default_str();
    command
        .add_option("--config", options.file,
                    "change it by a TOML file, with keys as `rtusim config` prints them")
        ->type_name("FILE")
        ->check(is_not_empty());
    command
        .add_option("--set", options.sets,
                    "change one key, after the file; repeatable: --set rtu.box.boxes_per_cycle=8")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

void add_link_option(CLI::App& command, MachineOptions& options) {
    command
        .add_option(
            "--link", options.link,
            fmt::format("rays come and hits go over a host link: {}", fmt::join(sim::link_names(), ", ")))
        ->type_name("NAME")
        ->capture_default_str();
}

sim::EffectiveConfig load(const MachineOptions& options) { return load(options, options.link); }

sim::EffectiveConfig load(const MachineOptions& options, const std::string& link) {
    const auto file =
        options.file.empty() ? std::nullopt : std::optional<std::filesystem::path>(options.file);
    return sim::load_config(options.preset, file, options.sets, link);
}

}  // namespace rtu::apps
