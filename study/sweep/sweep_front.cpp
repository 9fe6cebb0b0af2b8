#include "study/sweep/sweep_front.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rtu::study {
namespace {

// What was found of a design so far: the values of each objective, scene after scene.
using Found = std::vector<std::vector<double>>;

double geometric_mean(const std::vector<double>& values) {
    if (values.size() == 1) return values.front();  // which a logarithm would round
    double sum = 0;
    for (const double value : values) sum += std::log(value);
    return std::exp(sum / double(values.size()));
}

bool is_beaten_by(const RatedDesign& design, const RatedDesign& other,
                  std::span<const SweepObjective> objectives) {
    bool is_worse = false;
    for (std::size_t i = 0; i < objectives.size(); ++i) {
        if (objectives[i].is_better(design.values[i], other.values[i])) return false;
        is_worse = is_worse || objectives[i].is_better(other.values[i], design.values[i]);
    }
    return is_worse;
}

std::size_t scene_count(const SqlDatabase& database) {
    SqlStatement select =
        database.prepare("SELECT count(DISTINCT scene) FROM point WHERE number IS NOT NULL");
    return select.next() ? std::size_t(select.integer(0)) : 0;
}

}  // namespace

std::vector<RatedDesign> rated_designs(const SqlDatabase& database,
                                       std::span<const SweepObjective> objectives) {
    std::string columns;
    for (const SweepObjective& objective : objectives) columns += ", " + sql_name(objective.column);
    SqlStatement select = database.prepare(fmt::format(
        "SELECT design{} FROM results WHERE workload = 'total' AND number IS NOT NULL ORDER BY number",
        columns));
    std::map<std::string, Found> found;
    std::vector<std::string> order;
    while (select.next()) {
        const std::string id = select.text(0);
        Found& values = found[id];
        if (values.empty()) order.push_back(id);
        values.resize(objectives.size());
        for (std::size_t i = 0; i < objectives.size(); ++i) {
            const bool is_null = std::holds_alternative<std::monostate>(select.value(int(i) + 1));
            values[i].push_back(is_null ? std::nan("") : select.real(int(i) + 1));
        }
    }
    const std::size_t scenes = scene_count(database);
    std::vector<RatedDesign> result;
    for (const std::string& id : order) {
        RatedDesign design{id, {}};
        for (const std::vector<double>& values : found[id]) {
            design.values.push_back(values.size() == scenes ? geometric_mean(values) : std::nan(""));
        }
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
        const bool is_beaten = std::ranges::any_of(
            front, [&](const RatedDesign& other) { return is_beaten_by(design, other, objectives); });
        if (!is_beaten) front.push_back(std::move(design));
    }
    return front;
}

}  // namespace rtu::study
