#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rtu::sim {

/// A preset as it was embedded at build time from sim/presets/NAME.toml, or a link from sim/links/NAME.toml.
struct EmbeddedPreset {
    std::string_view name;
    std::string_view toml;
};

/// Every embedded preset; `default` first, then by name. Generated from sim/presets by CMake.
[[nodiscard]] std::span<const EmbeddedPreset> embedded_presets();

/// The names that load_config() accepts, in the same order.
[[nodiscard]] std::vector<std::string> preset_names();

/// The preset of that name; throws Error listing the known ones.
[[nodiscard]] const EmbeddedPreset& find_preset(std::string_view name);

/// Every embedded link: keys of the group `link` that replace a preset's. The oldest first.
[[nodiscard]] std::span<const EmbeddedPreset> embedded_links();

/// `none`, then the names of all links.
[[nodiscard]] std::vector<std::string> link_names();

/// The link of that name; throws Error listing the known ones.
[[nodiscard]] const EmbeddedPreset& find_link(std::string_view name);

}  // namespace rtu::sim
