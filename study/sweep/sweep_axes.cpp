#include "study/sweep/sweep_axes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "model/error.hpp"
#include "sim/config_keys.hpp"

namespace rtu::study {
namespace {

using sim::ConfigAssignment;
using ConfigText = std::variant<std::int64_t, std::string>;

constexpr std::size_t most_values = 65'536;  // of one axis

struct KeyNode {
    std::string name;
    std::string place;
    const toml::node* node;
    std::uint32_t line;
};

bool is_key(std::string_view name) {
    return std::ranges::find(sim::config_keys(), name, &sim::ConfigKey::name) != sim::config_keys().end();
}

// Keys may be dotted or nest in tables; what is no key's name and no table is an unknown key.
void collect(const TomlReader& reader, const toml::table& table, const std::string& prefix,
             std::vector<KeyNode>& found) {
    for (const auto& [key, node] : table) {
        const std::string name = prefix + std::string(key.str());
        const std::string place = reader.place(key);
        const toml::table* inner = node.as_table();
        if (is_key(name)) {
            found.push_back({name, place, &node, key.source().begin.line});
        } else if (inner != nullptr && !inner->empty()) {
            collect(reader, *inner, name + ".", found);
        } else {
            static_cast<void>(sim::config_key_index(name, place));  // throws
        }
    }
}

std::vector<KeyNode> keys_in_line_order(const TomlReader& reader, const toml::table& table) {
    std::vector<KeyNode> found;
    collect(reader, table, "", found);
    std::ranges::stable_sort(found, {}, &KeyNode::line);
    return found;
}

ConfigAssignment assignment(const TomlReader& reader, const KeyNode& key, const toml::node& value) {
    ConfigAssignment result{key.name, {}, {}, reader.place(value)};
    if (const auto* number = value.as_integer()) {
        result.value = number->get();
    } else if (const auto* text = value.as_string()) {
        result.value = text->get();
    } else {
        reader.fail(value, key.name + ": a whole number or a name");
    }
    static_cast<void>(sim::assign(sim::default_config(), result));  // for its errors
    return result;
}

std::vector<std::uint64_t> steps(std::uint64_t from, std::uint64_t to, std::uint64_t step) {
    std::vector<std::uint64_t> values;
    for (std::uint64_t value = from; value <= to && values.size() <= most_values; value += step) {
        values.push_back(value);
    }
    return values;
}

std::vector<std::uint64_t> products(std::uint64_t from, std::uint64_t to, double factor) {
    std::vector<std::uint64_t> values;
    for (double value = double(from); std::llround(value) <= std::llround(double(to)); value *= factor) {
        const auto rounded = std::uint64_t(std::llround(value));
        if (values.empty() || values.back() != rounded) values.push_back(rounded);
        if (values.size() > most_values) break;
    }
    return values;
}

double factor_of(const TomlReader& reader, const toml::node& node) {
    const auto factor = node.value<double>();
    if (!factor || !(*factor >= 1.001) || *factor > 1e6) {
        throw Error("{}: expected a factor, a number from 1.001 to 1000000", reader.place(node));
    }
    return *factor;
}

// { from, to, step } or { from, to, factor }.
std::vector<ConfigAssignment> range(const TomlReader& reader, const KeyNode& key, const toml::table& table) {
    reader.check_keys(table, {"from", "to", "step", "factor"});
    const toml::node *from = table.get("from"), *to = table.get("to");
    const toml::node *step = table.get("step"), *factor = table.get("factor");
    if (from == nullptr || to == nullptr || (step == nullptr) == (factor == nullptr)) {
        throw Error("{}: {}: expected {{ from, to, step }} or {{ from, to, factor }}", key.place, key.name);
    }
    constexpr std::uint64_t most = 4'000'000'000U;  // of any key
    const bool is_product = factor != nullptr;
    const std::uint64_t first = reader.number(*from, key.name + ": from", is_product ? 1 : 0, most);
    const std::uint64_t last = reader.number(*to, key.name + ": to", first, most);
    const std::vector<std::uint64_t> values =
        is_product ? products(first, last, factor_of(reader, *factor))
                   : steps(first, last, reader.number(*step, key.name + ": step", 1, most));
    std::vector<ConfigAssignment> result;
    for (const std::uint64_t value : values) {
        result.push_back({key.name, std::int64_t(value), {}, key.place});
        static_cast<void>(sim::assign(sim::default_config(), result.back()));  // for its errors
    }
    return result;
}

std::vector<ConfigAssignment> values_of(const TomlReader& reader, const KeyNode& key) {
    std::vector<ConfigAssignment> values;
    if (const toml::table* table = key.node->as_table()) {
        values = range(reader, key, *table);
    } else {
        const std::string expected = key.name + ": a list of values, or { from, to, step or factor }";
        for (const toml::node& value : reader.array(*key.node, expected)) {
            values.push_back(assignment(reader, key, value));
        }
    }
    if (values.empty() || values.size() > most_values) {
        throw Error("{}: {}: expected 1 to {} values, got {}", key.place, key.name, most_values,
                    values.empty() ? "none" : "more");
    }
    return values;
}

bool is_same(const std::vector<ConfigAssignment>& a, const std::vector<ConfigAssignment>& b) {
    return std::ranges::equal(a, b, {}, &ConfigAssignment::value, &ConfigAssignment::value);
}

// Linked keys may have a value twice, but not beside the same others.
void check_settings_once(const SweepAxis& axis) {
    for (std::size_t i = 0; i < axis.settings.size(); ++i) {
        const std::vector<ConfigAssignment>& setting = axis.settings[i];
        for (std::size_t j = 0; j < std::min(i, std::size_t{1000}); ++j) {
            if (!is_same(setting, axis.settings[j])) continue;
            throw Error("{}: {}: expected every {} once", setting.front().place, setting.front().key,
                        setting.size() == 1 ? "value" : "combination of linked values");
        }
    }
}

}  // namespace

std::vector<ConfigAssignment> parse_settings(const TomlReader& reader, const toml::table& table) {
    std::vector<ConfigAssignment> result;
    for (const KeyNode& key : keys_in_line_order(reader, table)) {
        result.push_back(assignment(reader, key, *key.node));
    }
    return result;
}

std::vector<SweepAxis> parse_axes(const TomlReader& reader, const toml::table& table) {
    std::vector<SweepAxis> axes;
    for (const KeyNode& key : keys_in_line_order(reader, table)) {
        SweepAxis& axis = axes.emplace_back();
        axis.place = key.place;
        for (ConfigAssignment& value : values_of(reader, key)) axis.settings.push_back({std::move(value)});
        check_settings_once(axis);
    }
    return axes;
}

SweepAxis parse_linked_axis(const TomlReader& reader, const toml::table& table) {
    SweepAxis axis;
    axis.place = reader.place(table);
    for (const KeyNode& key : keys_in_line_order(reader, table)) {
        std::vector<ConfigAssignment> values = values_of(reader, key);
        if (axis.settings.empty()) axis.settings.resize(values.size());
        if (values.size() != axis.settings.size()) {
            throw Error("{}: {}: expected {} values, as of the key linked with it, got {}", key.place,
                        key.name, axis.settings.size(), values.size());
        }
        for (std::size_t i = 0; i < values.size(); ++i) axis.settings[i].push_back(std::move(values[i]));
    }
    if (axis.settings.empty()) throw Error("{}: expected keys that change together, got none", axis.place);
    check_settings_once(axis);
    return axis;
}

void check_keys_once(const std::vector<ConfigAssignment>& fixed, const std::vector<SweepAxis>& axes) {
    std::map<std::string, std::string> places;
    const auto add = [&](const ConfigAssignment& assignment) {
        const auto [before, is_new] = places.emplace(assignment.key, assignment.place);
        if (is_new) return;
        throw Error("{}: expected every key in one place, got '{}' again (see {})", assignment.place,
                    assignment.key, before->second);
    };
    for (const ConfigAssignment& assignment : fixed) add(assignment);
    for (const SweepAxis& axis : axes) {
        for (const ConfigAssignment& assignment : axis.settings.front()) add(assignment);
    }
}

}  // namespace rtu::study
