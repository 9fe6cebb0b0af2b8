#include "study/sweep/sweep_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "sim/config_keys.hpp"
#include "study/text_table.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

constexpr std::size_t most_rows = 30;
constexpr std::size_t most_failures = 10;

// What differs between the designs of a sweep, as columns of a table.
class DesignColumns {
  public:
    explicit DesignColumns(const SweepPlan& plan) {
        const SweepDesign& first = plan.designs.front();
        const auto varies = [&](auto what) {
            return std::ranges::any_of(plan.designs, [&](const auto& d) { return what(d) != what(first); });
        };
        has_preset_ = varies([](const SweepDesign& d) { return d.preset; });
        has_pairing_ = varies([](const SweepDesign& d) { return to_string(d.pairing); });
        // What differs because the presets do is told by their names.
        for (const SweepAxis& axis : plan.file.axes) {
            for (const sim::ConfigAssignment& assignment : axis.settings.front()) {
                const sim::ConfigKey& key =
                    sim::config_keys()[sim::config_key_index(assignment.key, assignment.place)];
                if (varies([&](const SweepDesign& d) { return sim::config_value(d.config, key); }))
                    keys_.push_back(&key);
            }
        }
    }
    void add_columns(std::vector<TextTable::Column>& columns) const {
        if (has_preset_) columns.push_back({"Preset", left_aligned});
        if (has_pairing_) columns.push_back({"Pairing", left_aligned});
        for (const sim::ConfigKey* key : keys_) columns.push_back({two_lines(key->name)});
    }
    void add_cells(const SweepDesign& design, std::vector<std::string>& cells) const {
        if (has_preset_) cells.push_back(design.preset);
        if (has_pairing_) cells.push_back(to_string(design.pairing));
        for (const sim::ConfigKey* key : keys_) cells.push_back(config_value_text(design.config, *key));
    }

  private:
    static std::string two_lines(std::string_view key) {
        const std::size_t dot = key.rfind('.');
        if (dot == std::string_view::npos) return std::string(key);
        return fmt::format("{}\n{}", key.substr(0, dot), key.substr(dot + 1));
    }

    bool has_preset_ = false, has_pairing_ = false;
    std::vector<const sim::ConfigKey*> keys_;
};

std::string count_of(std::uint64_t count, const char* what) {
    return fmt::format("{} {}{}", grouped(count), what, count == 1 ? "" : "s");
}

std::string more_rows(std::size_t count, const std::string& where) {
    if (count <= most_rows) return "";
    return fmt::format("  ... and {} more{}\n", grouped(count - most_rows), where);
}

std::string objectives_text(const SweepFile& file) {
    std::vector<std::string> names;
    for (const SweepObjective& objective : file.objectives) names.push_back(objective.name());
    return fmt::format("{}", fmt::join(names, ", "));
}

// Or as whole as the geometric mean of a whole number is.
bool is_whole(double value) { return std::abs(value - std::round(value)) <= 1e-9 * value; }

std::string front_table(const SweepPlan& plan, const std::vector<RatedDesign>& front) {
    const DesignColumns varying(plan);
    std::vector<TextTable::Column> columns{{"Design", left_aligned}};
    for (const SweepObjective& objective : plan.file.objectives) columns.push_back({objective.name()});
    varying.add_columns(columns);
    std::map<std::string, const SweepDesign*> designs;
    for (const SweepDesign& design : plan.designs) designs[design.id] = &design;
    TextTable table(columns);
    for (std::size_t i = 0; i < std::min(front.size(), most_rows); ++i) {
        std::vector<std::string> cells{front[i].id};
        for (const double value : front[i].values) cells.push_back(fixed(value, is_whole(value) ? 0 : 3));
        varying.add_cells(*designs.at(front[i].id), cells);
        table.add_row(cells);
    }
    return table.text() + more_rows(front.size(), " (table `front`)");
}

std::string failure_text(const std::vector<SweepFailure>& failures) {
    if (failures.empty()) return "";
    std::string text = "\nFailed points (--retry-failed tries them again)\n";
    for (std::size_t i = 0; i < std::min(failures.size(), most_failures); ++i) {
        text += fmt::format("  {} ({}, design {}): {}\n", failures[i].point, failures[i].scene,
                            failures[i].design, failures[i].error);
    }
    if (failures.size() > most_failures)
        text += fmt::format("  ... and {} more\n", failures.size() - most_failures);
    return text;
}

// What a sweep of estimates simulated before it says what its front is.
std::string confirmation_text(const SweepPlan& plan, const SweepConfirmation& found) {
    if (plan.file.fidelity == FidelityLevel::Cycle) return "";
    return fmt::format(
        "Fidelity  {}; {} that the front may hold simulated with every ray\n"
        "          of {} so checked, {} within their interval, {:.2f} % off at most\n",
        to_string(plan.file.fidelity), count_of(found.designs, "design"), count_of(found.figures, "figure"),
        found.inside, found.largest_error_percent);
}

std::string heading(const SweepPlan& plan) {
    return fmt::format("Sweep     {}: {} in {}, {}; rtusim {}\n", plan.file.name,
                       count_of(plan.designs.size(), "design"), count_of(plan.scenes.size(), "scene"),
                       count_of(plan.scenes.size() * plan.designs.size(), "point"), version());
}

}  // namespace

std::string duration_text(double seconds) {
    if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
    const auto whole = std::uint64_t(std::llround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string sweep_text(const SweepPlan& plan, const SweepOutcome& outcome, const std::string& database) {
    std::string text = heading(plan);
    text += fmt::format("Points    {} done, {} failed", grouped(outcome.points.done),
                        grouped(outcome.points.failed));
    if (outcome.simulated == 0) {
        text += "; none were left to simulate\n";
    } else {
        text += fmt::format("; {} in this run, in {}{}\n", grouped(outcome.simulated),
                            duration_text(outcome.seconds),
                            outcome.workers == 0 ? "" : ", by " + count_of(outcome.workers, "worker"));
    }
    text += confirmation_text(plan, outcome.confirmation);
    text += fmt::format("Database  {} (table `results`; docs/sweeps.md)\n\nFront of {}: {} of {}\n\n",
                        database, objectives_text(plan.file), outcome.front.size(),
                        count_of(plan.designs.size(), "design"));
    return text + front_table(plan, outcome.front) + failure_text(outcome.failures);
}

std::string sweep_plan_text(const SweepPlan& plan, const SweepEstimate& estimate) {
    const DesignColumns varying(plan);
    std::vector<TextTable::Column> columns{{"Point", left_aligned}, {"Scene", left_aligned}};
    varying.add_columns(columns);
    TextTable table(columns);
    for (std::size_t i = 0; i < std::min(plan.scenes.size() * plan.designs.size(), most_rows); ++i) {
        const SweepPoint& point = plan.points[i];
        std::vector<std::string> cells{point.id, plan.scenes[point.scene].name};
        varying.add_cells(plan.designs[point.design], cells);
        table.add_row(cells);
    }
    return heading(plan) +
           fmt::format("Grid      {} before constraints and subset\n",
                       count_of(grid_size(plan.file), "design")) +
           fmt::format("Estimate  {} of CPU time, {} with {} of {} each; nothing was run\n\n",
                       duration_text(estimate.cpu_seconds),
                       duration_text(estimate.cpu_seconds / std::max(1U, estimate.workers)),
                       count_of(estimate.workers, "worker"), byte_size(estimate.worker_bytes)) +
           table.text() + more_rows(plan.scenes.size() * plan.designs.size(), "");
}

std::string front_json(const SweepPlan& plan, const SweepOutcome& outcome) {
    using Json = nlohmann::ordered_json;
    Json objectives = Json::array(), designs = Json::array();
    for (const SweepObjective& objective : plan.file.objectives) objectives.push_back(objective.name());
    std::map<std::string, const SweepDesign*> known;
    for (const SweepDesign& design : plan.designs) known[design.id] = &design;
    for (const RatedDesign& rated : outcome.front) {
        const SweepDesign& design = *known.at(rated.id);
        designs.push_back({{"design", rated.id},
                           {"values", rated.values},
                           {"preset", design.preset},
                           {"pairing", to_string(design.pairing)},
                           {"sets", design.sets}});
    }
    return Json{{"sweep", plan.file.name}, {"objectives", objectives}, {"designs", designs}}.dump(2) + "\n";
}

}  // namespace rtu::study
