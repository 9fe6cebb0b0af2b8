#include "sim/effective_config.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <set>
#include <utility>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "sim/config_file.hpp"
#include "sim/presets.hpp"

namespace rtu::sim {
namespace {

std::string value_text(const ConfigAssignment& assignment) {
    if (const auto* number = std::get_if<std::int64_t>(&assignment.value)) return fmt::format("{}", *number);
    return fmt::format("'{}'", model::one_line(std::get<std::string>(assignment.value)));
}

[[noreturn]] void reject(const ConfigAssignment& assignment, const ConfigKey& key) {
    throw Error("{}: {}: expected {}{}{}, got {}", assignment.place, key.name, describe_range(key),
                key.unit.empty() ? "" : " ", key.unit, value_text(assignment));
}

bool has_form(std::uint32_t value, ConfigKey::Form form) {
    if (form == ConfigKey::Form::Even) return value % 2 == 0;
    return form == ConfigKey::Form::Any || std::has_single_bit(value);
}

std::uint32_t checked_number(const ConfigAssignment& assignment, const ConfigKey& key) {
    const auto* number = std::get_if<std::int64_t>(&assignment.value);
    if (number == nullptr || *number < key.min || *number > key.max) reject(assignment, key);
    const auto value = std::uint32_t(*number);
    if (!has_form(value, key.form)) reject(assignment, key);
    return value;
}

/// Where the choice stands among its names.
std::size_t checked_choice(const ConfigAssignment& assignment, const ConfigKey& key,
                           std::span<const std::string_view> names) {
    const auto* name = std::get_if<std::string>(&assignment.value);
    const auto found = name == nullptr ? names.end() : std::ranges::find(names, *name);
    if (found == names.end()) reject(assignment, key);
    return std::size_t(found - names.begin());
}

EffectiveConfig assign_all(EffectiveConfig config, std::span<const ConfigAssignment> assignments) {
    for (const ConfigAssignment& assignment : assignments) config = assign(std::move(config), assignment);
    return config;
}

std::string trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return std::string(text.substr(begin, text.find_last_not_of(" \t") + 1 - begin));
}

/// A preset's machine. What its file does not name it takes over from the default machine, whose sources
/// speak of other hardware: in a preset such a value is an assumption.
EffectiveConfig preset_config(const EmbeddedPreset& preset) {
    EffectiveConfig config =
        assign_all(default_config(), parse_config_toml(preset.toml, fmt::format("preset {}", preset.name)));
    if (&preset == &embedded_presets().front()) return config;
    for (EffectiveConfig::Origin& origin : config.origins) {
        if (!origin.place.empty()) continue;
        const bool is_assumed = origin.source.starts_with("assumed");
        origin.source =
            is_assumed ? "assumed: as default" : fmt::format("assumed: as default, {}", origin.source);
    }
    return config;
}

/// "key=value" of an option; what does not read as a number is taken for the name of a choice.
ConfigAssignment parse_set(const std::string& text) {
    const std::string place = fmt::format("--set {}", model::one_line(text));
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw Error("{}: expected key=value", place);
    ConfigAssignment assignment{
        trimmed(std::string_view(text).substr(0, equals)), {}, "set by option", place};
    const std::string value = trimmed(std::string_view(text).substr(equals + 1));
    std::int64_t number = 0;
    const char* const end = value.data() + value.size();
    const auto parsed = std::from_chars(value.data(), end, number);
    if (parsed.ec == std::errc() && parsed.ptr == end) {
        assignment.value = number;
    } else {
        assignment.value = value;
    }
    return assignment;
}

std::vector<ConfigAssignment> parse_sets(std::span<const std::string> sets) {
    std::vector<ConfigAssignment> assignments;
    std::set<std::string> seen;
    for (const std::string& text : sets) {
        assignments.push_back(parse_set(text));
        if (!seen.insert(assignments.back().key).second) {
            throw Error("{}: expected every key once, got '{}' again", assignments.back().place,
                        assignments.back().key);
        }
    }
    return assignments;
}

}  // namespace

EffectiveConfig default_config() {
    EffectiveConfig result;
    for (const ConfigKey& key : config_keys()) result.origins.push_back({std::string(key.source), {}});
    return result;
}

EffectiveConfig assign(EffectiveConfig base, const ConfigAssignment& assignment) {
    const std::size_t index = config_key_index(assignment.key, assignment.place);
    const ConfigKey& key = config_keys()[index];
    const ConfigKey::Field field = key.field(base.config);
    if (auto* const* number = std::get_if<std::uint32_t*>(&field)) {
        **number = checked_number(assignment, key);
    } else {
        const std::size_t choice = checked_choice(assignment, key, choice_names(field));
        std::visit([&](auto* place) { *place = std::remove_pointer_t<decltype(place)>(choice); }, field);
    }
    const std::string& source = assignment.source.empty() ? assignment.place : assignment.source;
    base.origins[index] = {source, assignment.place};
    return base;
}

EffectiveConfig load_config(std::string_view preset, const std::optional<std::filesystem::path>& file,
                            std::span<const std::string> sets, std::string_view link) {
    EffectiveConfig config = preset_config(find_preset(preset));
    if (link != "none") {
        config = assign_all(std::move(config),
                            parse_config_toml(find_link(link).toml, fmt::format("link {}", link)));
    }
    if (file) config = assign_all(std::move(config), read_config_file(*file));
    config = assign_all(std::move(config), parse_sets(sets));
    validate(config);
    return config;
}

}  // namespace rtu::sim
