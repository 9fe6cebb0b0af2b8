#include "study/sweep/sweep_objective.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <vector>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "sim/config_keys.hpp"

namespace rtu::study {
namespace {

struct Measure {
    std::string_view name;
    bool is_maximised;
    bool needs_counters;
};

constexpr std::array measures{
    Measure{"mrps", true, false},           Measure{"mrps_per_mgate", true, false},
    Measure{"mgates", false, false},        Measure{"bytes_per_ray", false, true},
    Measure{"box_utilisation", true, true}, Measure{"pair_utilisation", true, true}};

SweepObjective of_key(std::string_view key_name, bool is_maximised, const std::string& place) {
    const sim::ConfigKey& key = sim::config_keys()[sim::config_key_index(key_name, place)];
    if (std::holds_alternative<std::string_view>(sim::config_value({}, key))) {
        throw Error("{}: expected an objective that is a number, got '{}'", place, key_name);
    }
    return {std::string(key_name), is_maximised};
}

}  // namespace

std::string SweepObjective::name() const {
    if (std::ranges::find(measures, column, &Measure::name) != measures.end()) return column;
    return fmt::format("{} {}", is_maximised ? "max" : "min", column);
}

bool SweepObjective::needs_counters() const {
    const auto measure = std::ranges::find(measures, column, &Measure::name);
    return measure != measures.end() && measure->needs_counters;
}

bool SweepObjective::has_interval() const { return column == "mrps" || column == "mrps_per_mgate"; }

SweepObjective parse_sweep_objective(std::string_view text, const std::string& place) {
    const auto measure = std::ranges::find(measures, text, &Measure::name);
    if (measure != measures.end()) return {std::string(text), measure->is_maximised};
    if (text.starts_with("min ")) return of_key(text.substr(4), false, place);
    if (text.starts_with("max ")) return of_key(text.substr(4), true, place);
    std::vector<std::string_view> names;
    for (const Measure& known : measures) names.push_back(known.name);
    throw Error("{}: expected an objective ({}, 'min KEY' or 'max KEY'), got '{}'", place,
                fmt::join(names, ", "), model::one_line(text));
}

}  // namespace rtu::study
