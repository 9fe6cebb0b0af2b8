#include "study/sweep/sweep_front.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace rtu::study {
namespace {

// What was found of one objective of a design so far, scene after scene.
struct Found {
    std::vector<double> values, best, worst;
};

struct FoundDesign {
    std::vector<Found> objectives;
    bool is_estimate = false;
};

double geometric_mean(const std::vector<double>& values) {
    if (values.size() == 1) return values.front();  // which a logarithm would round
    double sum = 0;
    for (const double value : values) sum += std::log(value);
    return std::exp(sum / double(values.size()));
}

bool is_beaten(std::span<const double> values, std::span<const double> others,
               std::span<const SweepObjective> objectives) {
    bool is_worse = false;
    for (std::size_t i = 0; i < objectives.size(); ++i) {
        if (objectives[i].is_better(values[i], others[i])) return false;
        is_worse = is_worse || objectives[i].is_better(others[i], values[i]);
    }
    return is_worse;
}

std::size_t scene_count(const SqlDatabase& database) {
    SqlStatement select =
        database.prepare("SELECT count(DISTINCT scene) FROM point WHERE number IS NOT NULL");
    return select.next() ? std::size_t(select.integer(0)) : 0;
}

// Three columns an objective: its value, and the ends of its interval.
std::string columns_of(const SweepObjective& objective) {
    const std::string value = sql_name(objective.column);
    if (!objective.has_interval()) return fmt::format(", {0}, {0}, {0}", value);
    return fmt::format(", {}, {}, {}", value, sql_name(objective.column + "_low"),
                       sql_name(objective.column + "_high"));
}

void add_scene(const SqlStatement& row, std::size_t index, const SweepObjective& objective, Found& found) {
    const int column = 2 + 3 * int(index);
    const auto number = [&](int at, double missing) {
        return std::holds_alternative<std::monostate>(row.value(at)) ? missing : row.real(at);
    };
    const double low = number(column + 1, 0);
    const double high = number(column + 2, std::numeric_limits<double>::infinity());
    found.values.push_back(number(column, std::nan("")));
    found.best.push_back(objective.is_maximised ? high : low);
    found.worst.push_back(objective.is_maximised ? low : high);
}

RatedDesign rated(const std::string& id, const FoundDesign& found, std::size_t scenes) {
    RatedDesign design{.id = id, .values = {}, .is_estimate = found.is_estimate};
    for (const Found& objective : found.objectives) {
        const bool is_whole = objective.values.size() == scenes;
        design.values.push_back(is_whole ? geometric_mean(objective.values) : std::nan(""));
        design.best.push_back(geometric_mean(objective.best));
        design.worst.push_back(geometric_mean(objective.worst));
    }
    return design;
}

// The estimates that no design is sure to beat.
std::vector<std::string> possible_front(const std::vector<RatedDesign>& designs,
                                        std::span<const SweepObjective> objectives) {
    std::vector<std::string> result;
    for (const RatedDesign& design : designs) {
        const bool is_beaten_surely = std::ranges::any_of(designs, [&](const RatedDesign& other) {
            return is_beaten(design.best, other.worst, objectives);
        });
        if (design.is_estimate && !is_beaten_surely) result.push_back(design.id);
    }
    return result;
}

}  // namespace

std::vector<RatedDesign> rated_designs(const SqlDatabase& database,
                                       std::span<const SweepObjective> objectives) {
    std::string columns;
    for (const SweepObjective& objective : objectives) columns += columns_of(objective);
    SqlStatement select = database.prepare(fmt::format(
        "SELECT design, fidelity{} FROM answers WHERE workload = 'total' ORDER BY number", columns));
    std::map<std::string, FoundDesign> found;
    std::vector<std::string> order;
    while (select.next()) {
        const std::string id = select.text(0);
        FoundDesign& design = found[id];
        if (design.objectives.empty()) order.push_back(id);
        design.objectives.resize(objectives.size());
        design.is_estimate = design.is_estimate || select.text(1) != "cycle";
        for (std::size_t i = 0; i < objectives.size(); ++i)
            add_scene(select, i, objectives[i], design.objectives[i]);
    }
    const std::size_t scenes = scene_count(database);
    std::vector<RatedDesign> result;
    for (const std::string& id : order) {
        RatedDesign design = rated(id, found[id], scenes);
        if (std::ranges::none_of(design.values, [](double value) { return std::isnan(value); }))
            result.push_back(std::move(design));
    }
    return result;
}

std::vector<RatedDesign> pareto_front(std::vector<RatedDesign> designs,
                                      std::span<const SweepObjective> objectives) {
    // Sorted so, a design can only be beaten by one before it.
    std::ranges::stable_sort(designs, [&](const RatedDesign& a, const RatedDesign& b) {
        for (std::size_t i = 0; i < objectives.size(); ++i) {
            if (a.values[i] != b.values[i]) return objectives[i].is_better(a.values[i], b.values[i]);
        }
        return false;
    });
    std::vector<RatedDesign> front;
    for (RatedDesign& design : designs) {
        const bool is_out = std::ranges::any_of(front, [&](const RatedDesign& other) {
            return is_beaten(design.values, other.values, objectives);
        });
        if (!is_out) front.push_back(std::move(design));
    }
    return front;
}

std::vector<std::string> front_to_confirm(std::vector<RatedDesign> designs,
                                          const std::set<std::string>& confirmed,
                                          std::span<const SweepObjective> objectives) {
    // One that was asked for already and is still an estimate has failed in some scene.
    std::erase_if(designs, [&](const RatedDesign& d) { return d.is_estimate && confirmed.contains(d.id); });
    std::vector<std::string> result;
    for (const RatedDesign& design : pareto_front(designs, objectives)) {
        if (design.is_estimate) result.push_back(design.id);
    }
    return result.empty() ? possible_front(designs, objectives) : result;
}

SweepConfirmation confirmation(const SqlDatabase& database) {
    SqlStatement select = database.prepare(
        "SELECT count(DISTINCT a.design), count(*), total(a.mrps_low <= b.mrps AND b.mrps <= "
        "ifnull(a.mrps_high, "
        "b.mrps)), ifnull(max(abs(100.0 * (a.mrps / b.mrps - 1))), 0) FROM results a JOIN results b ON "
        "a.design "
        "= b.design AND a.scene = b.scene AND a.workload = b.workload AND a.fidelity <> 'cycle' AND "
        "b.fidelity = "
        "'cycle' AND a.number IS NOT NULL AND b.number IS NOT NULL AND a.workload <> 'total' AND b.mrps > 0");
    SweepConfirmation result;
    if (!select.next()) return result;
    result.designs = std::uint64_t(select.integer(0));
    result.figures = std::uint64_t(select.integer(1));
    result.inside = std::uint64_t(select.integer(2));
    result.largest_error_percent = select.real(3);
    return result;
}

}  // namespace rtu::study
