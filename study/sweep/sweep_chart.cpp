#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "sim/config_keys.hpp"
#include "study/sweep/sweep_chart_parser.hpp"

namespace rtu::study {
namespace {

constexpr std::array chart_measures{"mrps",          "mrps_per_mgate",  "mgates",           "sram_mbits",
                                    "bytes_per_ray", "box_utilisation", "pair_utilisation", "l1_hit_percent",
                                    "l2_hit_percent"};
constexpr std::array plain_columns{"preset", "pairing", "scene", "workload"};

bool is_file_name(const std::string& text) {
    return !text.empty() &&
           std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

class ChartParser {
  public:
    ChartParser(const TomlReader& reader, const toml::table& table) : reader_(reader), table_(table) {}

    SweepChart run(std::span<const SweepChart> others) {
        reader_.check_keys(table_, {"name", "title", "x", "logarithmic", "y", "series", "panels", "workload",
                                    "where", "against"});
        read_name(others);
        chart_.title = required("title");
        chart_.x = column(node("x"));
        if (const toml::node* flag = table_.get("logarithmic")) {
            if (!flag->is_boolean()) reader_.fail(*flag, "logarithmic = true or false");
            chart_.is_x_logarithmic = flag->value<bool>().value();
        }
        read_measure();
        if (const toml::node* series = table_.get("series")) {
            for (const toml::node& element : reader_.array(*series, "series, a list of columns"))
                chart_.series.push_back(column(element));
        }
        if (const toml::node* panels = table_.get("panels")) chart_.panels = column(*panels);
        if (const toml::node* workload = table_.get("workload"))
            chart_.workload = reader_.text(*workload, "a workload, or total");
        if (const toml::node* where = table_.get("where")) chart_.where = filter(*where);
        if (const toml::node* against = table_.get("against")) read_against(*against);
        return std::move(chart_);
    }

  private:
    const toml::node& node(const char* key) const {
        const toml::node* found = table_.get(key);
        if (found == nullptr) throw Error("{}: a chart needs {}", reader_.place(table_), key);
        return *found;
    }

    [[nodiscard]] std::string required(const char* key) const { return reader_.text(node(key), key); }

    void read_name(std::span<const SweepChart> others) {
        chart_.name = required("name");
        const std::string place = reader_.place(node("name"));
        if (!is_file_name(chart_.name)) {
            throw Error("{}: expected a chart's name of letters, digits and underscores, got '{}'", place,
                        model::one_line(chart_.name));
        }
        if (std::ranges::find(others, chart_.name, &SweepChart::name) != others.end())
            throw Error("{}: two charts are called '{}'", place, chart_.name);
    }

    void read_measure() {
        const toml::node* y = table_.get("y");
        if (y == nullptr) return;
        chart_.y = reader_.text(*y, "a measure");
        if (std::ranges::find(chart_measures, chart_.y) == chart_measures.end()) {
            throw Error("{}: expected one of {}, got '{}'", reader_.place(*y),
                        fmt::join(chart_measures, ", "), model::one_line(chart_.y));
        }
    }

    // A configuration key, or one of the plain columns.
    std::string known_column(const std::string& name, const std::string& place) const {
        if (std::ranges::find(plain_columns, name) != plain_columns.end()) return name;
        return std::string(sim::config_keys()[sim::config_key_index(name, place)].name);
    }
    std::string column(const toml::node& element) const {
        return known_column(reader_.text(element, "a column"), reader_.place(element));
    }

    SweepFilter filter(const toml::node& element) const {
        SweepFilter result;
        for (const auto& [key, value] : reader_.table(element, "{ 'COLUMN' = VALUE }")) {
            const std::string name = known_column(std::string(key.str()), reader_.place(key));
            if (const auto number = value.value_exact<std::int64_t>()) {
                result.emplace_back(name, fmt::format("{}", *number));
            } else {
                result.emplace_back(name, reader_.text(value, "a whole number or a name"));
            }
        }
        return result;
    }

    void read_against(const toml::node& element) {
        if (element.is_table()) {
            chart_.against = SweepChart::Against::Base;
            chart_.base = filter(element);
            return;
        }
        if (reader_.text(element, "against = 'best' or { 'COLUMN' = VALUE }") != "best")
            throw Error("{}: expected against = 'best' or {{ 'COLUMN' = VALUE }}", reader_.place(element));
        chart_.against = SweepChart::Against::Best;
    }

    const TomlReader& reader_;
    const toml::table& table_;
    SweepChart chart_;
};

}  // namespace

std::vector<std::string> SweepChart::columns() const {
    std::vector<std::string> result{x};
    result.insert(result.end(), series.begin(), series.end());
    if (!panels.empty()) result.push_back(panels);
    return result;
}

bool SweepChart::has_column(const std::string& column) const {
    const std::vector<std::string> all = columns();
    return std::ranges::find(all, column) != all.end();
}

SweepChart parse_sweep_chart(const TomlReader& reader, const toml::table& table,
                             std::span<const SweepChart> others) {
    return ChartParser(reader, table).run(others);
}

}  // namespace rtu::study
