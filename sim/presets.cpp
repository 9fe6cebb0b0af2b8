#include "sim/presets.hpp"

#include <algorithm>

#include "model/error.hpp"
#include "model/one_line.hpp"

namespace rtu::sim {

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const EmbeddedPreset& preset : embedded_presets()) names.emplace_back(preset.name);
    return names;
}

const EmbeddedPreset& find_preset(std::string_view name) {
    const auto presets = embedded_presets();
    const auto found = std::ranges::find(presets, name, &EmbeddedPreset::name);
    if (found == presets.end()) {
        throw Error("preset: expected one of {}, got '{}'", fmt::join(preset_names(), ", "),
                    model::one_line(name));
    }
    return *found;
}

}  // namespace rtu::sim
