#include <algorithm>
#include <string>

#include "model/error.hpp"
#include "sim/effective_config.hpp"
#include "sim/presets.hpp"

namespace rtu::sim {
namespace {

/// A TOML basic string.
std::string toml_string(std::string_view text) {
    std::string result = "\"";
    for (const char character : text) {
        const auto code = static_cast<unsigned char>(character);
        if (character == '"' || character == '\\') {
            result += '\\';
            result += character;
        } else if (code < 0x20 || code == 0x7f) {
            result += fmt::format("\\u{:04x}", code);
        } else {
            result += character;
        }
    }
    return result + '"';
}

/// Everything up to the last dot: keys with the same group print together.
std::string_view group_of(std::string_view name) {
    return name.substr(0, std::min(name.rfind('.'), name.size()));
}

bool is_in_group(std::string_view name) { return name.find('.') != std::string_view::npos; }

std::string toml_value(const Config& config, const ConfigKey& key) {
    const std::string text = config_value_text(config, key);
    return std::holds_alternative<std::uint32_t>(config_value(config, key)) ? text : toml_string(text);
}

std::string unit_and_range(const ConfigKey& key) {
    return fmt::format("{}{}{}", describe_range(key), key.unit.empty() ? "" : " ", key.unit);
}

/// Text as it must stand in a cell.
std::string cell(std::string_view text) {
    std::string result;
    for (const char character : text) {
        if (character == '|') result += '\\';
        result += character;
    }
    return result;
}

bool is_assumed(std::string_view source) { return source.starts_with("assumed"); }

}  // namespace

std::string describe_config(const EffectiveConfig& effective) {
    std::size_t name_width = 0;
    for (const ConfigKey& key : config_keys()) name_width = std::max(name_width, key.name.size());
    std::string text;
    std::string_view group;
    for (std::size_t i = 0; i < config_keys().size(); ++i) {
        const ConfigKey& key = config_keys()[i];
        const std::string_view key_group = is_in_group(key.name) ? group_of(key.name) : std::string_view();
        if (key_group != group) text += '\n';
        group = key_group;
        text += fmt::format("# {} ({})\n{:<{}} = {{ value = {}, source = {} }}\n", key.meaning,
                            unit_and_range(key), key.name, name_width, toml_value(effective.config, key),
                            toml_string(effective.origins[i].source));
    }
    return text;
}

std::string config_markdown(const EffectiveConfig& effective) {
    std::string text = "| key | value | unit | allowed | meaning | source |\n|---|--:|---|---|---|---|\n";
    for (std::size_t i = 0; i < config_keys().size(); ++i) {
        const ConfigKey& key = config_keys()[i];
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name,
                            config_value_text(effective.config, key), cell(key.unit), describe_range(key),
                            cell(key.meaning), cell(effective.origins[i].source));
    }
    return text;
}

std::string presets_markdown() {
    std::vector<EffectiveConfig> presets;
    std::string text = "| key | unit |";
    std::string rule = "|---|---|";
    for (const std::string& name : preset_names()) {
        presets.push_back(load_config(name, {}, {}));
        text += fmt::format(" `{}` |", name);
        rule += "--:|";
    }
    text += '\n' + rule + '\n';
    for (std::size_t i = 0; i < config_keys().size(); ++i) {
        const ConfigKey& key = config_keys()[i];
        text += fmt::format("| `{}` | {} |", key.name, cell(key.unit));
        for (const EffectiveConfig& preset : presets) {
            const std::string_view mark = is_assumed(preset.origins[i].source) ? "*" : "";
            text += fmt::format(" {}{}{} |", mark, config_value_text(preset.config, key), mark);
        }
        text += '\n';
    }
    return text;
}

}  // namespace rtu::sim
