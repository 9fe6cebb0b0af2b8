#include "sim/presets.hpp"

#include <algorithm>

#include "model/error.hpp"
#include "model/one_line.hpp"

namespace rtu::sim {

namespace {

const EmbeddedPreset& find(std::span<const EmbeddedPreset> presets, std::string_view name,
                           std::string_view what, const std::vector<std::string>& known) {
    const auto found = std::ranges::find(presets, name, &EmbeddedPreset::name);
    if (found == presets.end()) {
        throw Error("{}: expected one of {}, got '{}'", what, fmt::join(known, ", "), model::one_line(name));
    }
    return *found;
}

}  // namespace

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const EmbeddedPreset& preset : embedded_presets()) names.emplace_back(preset.name);
    return names;
}

const EmbeddedPreset& find_preset(std::string_view name) {
    return find(embedded_presets(), name, "preset", preset_names());
}

std::vector<std::string> link_names() {
    std::vector<std::string> names{"none"};
    for (const EmbeddedPreset& link : embedded_links()) names.emplace_back(link.name);
    return names;
}

const EmbeddedPreset& find_link(std::string_view name) {
    return find(embedded_links(), name, "link", link_names());
}

}  // namespace rtu::sim
