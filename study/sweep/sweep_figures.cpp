#include "study/sweep/sweep_figures.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "model/error.hpp"
#include "sim/config_keys.hpp"
#include "study/sweep/sweep_objective.hpp"

namespace rtu::study {
namespace {

using Against = SweepChart::Against;

struct Bounded {
    double value = 0, low = 0, high = 0;
};

// A row of one scene and one workload.
struct Sample {
    std::string panel, series, x;
    std::string where;   // scene and workload
    std::string design;  // all of it but the columns of the base; empty unless there is one
    bool is_base = false;
    Bounded y;
};

bool has(const SweepFilter& filter, std::string_view column) {
    return std::ranges::any_of(filter, [&](const auto& condition) { return condition.first == column; });
}

std::string joined(const std::vector<std::string>& columns) {
    if (columns.empty()) return "''";
    std::vector<std::string> names;
    for (const std::string& column : columns) names.push_back(sql_name(column));
    return fmt::format("{}", fmt::join(names, " || ' ' || "));
}

std::string joined_design(const SweepFilter& base) {
    std::vector<std::string> columns;
    for (const char* name : {"preset", "pairing"})
        if (!has(base, name)) columns.emplace_back(name);
    for (const sim::ConfigKey& key : sim::config_keys())
        if (!has(base, key.name)) columns.emplace_back(key.name);
    return joined(columns);
}

// A condition on a column as text, whose value is a parameter.
std::string condition(const std::string& column, int parameter) {
    return fmt::format("CAST({} AS TEXT) = ?{}", sql_name(column), parameter);
}

// The parameters of `where` follow the workload, those of the base follow them.
std::string base_condition(const SweepChart& chart) {
    if (chart.against != Against::Base) return "0";
    std::string text = "1";
    int parameter = 2 + int(chart.where.size());
    for (const auto& [column, value] : chart.base) text += " AND " + condition(column, parameter++);
    return text;
}

// A condition on a column of the base does not hold for the bases themselves.
std::string where_condition(const SweepChart& chart) {
    std::string text = "1";
    int parameter = 2;
    for (const auto& [column, value] : chart.where) {
        const std::string exception = has(chart.base, column) ? " OR " + base_condition(chart) : "";
        text += fmt::format(" AND ({}{})", condition(column, parameter++), exception);
    }
    return text;
}

SweepObjective measure_of(const SweepChart& chart) {
    if (chart.y == "sram_mbits") return {chart.y, false};
    if (chart.y.ends_with("_hit_percent")) return {chart.y, true};
    return parse_sweep_objective(chart.y, chart.name);
}

std::string query(const SweepChart& chart) {
    const bool has_base = chart.against == Against::Base;
    const std::string y = sql_name(chart.y);
    const bool is_bounded = measure_of(chart).has_interval();
    return fmt::format(
        "SELECT {}, {}, {}, scene || ' ' || workload, {}, {}, {}, {}, {} FROM answers a WHERE workload {}"
        " AND {} IS NOT NULL AND {} ORDER BY (SELECT min(number) FROM point p WHERE p.design = a.design AND"
        " p.scene = a.scene AND number IS NOT NULL), instr('primary shadow ao diffuse random', workload)",
        chart.panels.empty() ? "''" : sql_name(chart.panels), joined(chart.series), sql_name(chart.x),
        has_base ? joined_design(chart.base) : "''", base_condition(chart), y,
        is_bounded ? sql_name(chart.y + "_low") : y, is_bounded ? sql_name(chart.y + "_high") : y,
        chart.has_column("workload") ? "<> ?1" : "= ?1", y, where_condition(chart));
}

std::vector<Sample> read_samples(const SqlDatabase& database, const SweepChart& chart) {
    SqlStatement select = database.prepare(query(chart));
    select.bind(1, chart.has_column("workload") ? "total" : chart.workload);
    int parameter = 2;
    for (const auto* filter : {&chart.where, &chart.base})
        for (const auto& [column, value] : *filter) select.bind(parameter++, value);
    std::vector<Sample> samples;
    while (select.next()) {
        const bool has_high = !std::holds_alternative<std::monostate>(select.value(8));
        const double high = has_high ? select.real(8) : std::numeric_limits<double>::infinity();
        samples.push_back({select.text(0),
                           select.text(1),
                           select.text(2),
                           select.text(3),
                           select.text(4),
                           select.integer(5) != 0,
                           {select.real(6), select.real(7), high}});
    }
    if (samples.empty()) throw Error("chart {}: no row of the sweep is left for it", chart.name);
    return samples;
}

// The best sample at each place of the chart, and in each scene.
std::vector<Sample> best_of_each(std::vector<Sample> samples, const SweepObjective& measure) {
    std::map<std::tuple<std::string, std::string, std::string, std::string>, std::size_t> known;
    std::vector<Sample> result;
    for (Sample& sample : samples) {
        const auto [place, is_new] =
            known.try_emplace({sample.panel, sample.series, sample.x, sample.where}, result.size());
        if (is_new) {
            result.push_back(std::move(sample));
        } else if (measure.is_better(sample.y.value, result[place->second].y.value)) {
            result[place->second] = std::move(sample);
        }
    }
    return result;
}

Bounded ratio(const Bounded& a, const Bounded& b) {
    return {a.value / b.value, a.low / b.high, a.high / b.low};
}

// Divides every sample by the best of its panel, scene and workload.
void divide_by_best(std::vector<Sample>& samples, const SweepObjective& measure) {
    std::map<std::pair<std::string, std::string>, Bounded> best;
    for (const Sample& sample : samples) {
        const auto [place, is_new] = best.try_emplace({sample.panel, sample.where}, sample.y);
        if (!is_new && measure.is_better(sample.y.value, place->second.value)) place->second = sample.y;
    }
    for (Sample& sample : samples) {
        const Bounded by = best.at({sample.panel, sample.where});
        sample.y = {sample.y.value / by.value, sample.y.low / by.value, sample.y.high / by.value};
    }
}

// A chart that does not show by which column its rows differ from their bases shows the other rows only, and
// so does one that chooses them by such a column.
bool shows_bases(const SweepChart& chart) {
    const auto is_shown = [&](const auto& column) { return chart.has_column(column.first); };
    const auto is_chosen = [&](const auto& column) { return has(chart.where, column.first); };
    return std::ranges::any_of(chart.base, is_shown) && std::ranges::none_of(chart.base, is_chosen);
}

// Divides every sample by its base; those without one are left out.
std::vector<Sample> divided_by_base(const SweepChart& chart, std::vector<Sample> samples) {
    std::map<std::pair<std::string, std::string>, Bounded> bases;
    for (const Sample& sample : samples)
        if (sample.is_base) bases.emplace(std::pair(sample.where, sample.design), sample.y);
    std::erase_if(samples, [&](const Sample& s) {
        return !bases.contains({s.where, s.design}) || (s.is_base && !shows_bases(chart));
    });
    if (samples.empty()) throw Error("chart {}: no row has a base to be compared with", chart.name);
    for (Sample& sample : samples) {
        const Bounded& base = bases.at({sample.where, sample.design});
        sample.y = sample.is_base ? Bounded{1, 1, 1} : ratio(sample.y, base);
    }
    return samples;
}

// A share as the chart shows it.
double shown(const SweepChart& chart, double value) {
    if (chart.against == Against::Best) return 100 * value;
    return chart.against == Against::Base ? 100 * (value - 1) : value;
}

// Several scenes: the spread of their values, which is wider than an interval; one: its interval.
std::vector<SweepFigure> means(const SweepChart& chart, const std::vector<Sample>& samples) {
    struct Sum {
        SweepFigure figure;
        double log_sum = 0, low = 0, high = 0;
    };
    std::vector<Sum> sums;
    std::map<std::tuple<std::string, std::string, std::string>, std::size_t> known;
    for (const Sample& sample : samples) {
        const auto [place, is_new] = known.try_emplace({sample.panel, sample.series, sample.x}, sums.size());
        if (is_new)
            sums.push_back(
                {{sample.panel, sample.series, sample.x, 0, 0, 0, 0}, 0, sample.y.low, sample.y.high});
        Sum& sum = sums[place->second];
        ++sum.figure.samples;
        sum.log_sum += std::log(sample.y.value);
        sum.low = std::min(sum.low, sample.y.low);
        sum.high = std::max(sum.high, sample.y.high);
    }
    std::vector<SweepFigure> figures;
    for (Sum& sum : sums) {
        sum.figure.value = shown(chart, std::exp(sum.log_sum / double(sum.figure.samples)));
        sum.figure.least = shown(chart, sum.low);
        sum.figure.most = shown(chart, sum.high);
        figures.push_back(std::move(sum.figure));
    }
    return figures;
}

}  // namespace

std::vector<SweepFigure> sweep_figures(const SqlDatabase& database, const SweepChart& chart) {
    const SweepObjective measure = measure_of(chart);
    std::vector<Sample> samples = read_samples(database, chart);
    if (chart.against == Against::Base) {
        samples = divided_by_base(chart, std::move(samples));
    } else {
        samples = best_of_each(std::move(samples), measure);
        if (chart.against == Against::Best) divide_by_best(samples, measure);
    }
    return means(chart, samples);
}

}  // namespace rtu::study
