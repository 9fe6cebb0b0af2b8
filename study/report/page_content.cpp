#include "study/report/page_content.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

// Six digits are more than a chart shows, and a third of the bytes of seventeen.
Json number(double value) {
    if (!std::isfinite(value)) return nullptr;
    if (value == std::floor(value) && std::abs(value) < 9e15) return std::int64_t(value);
    const std::string text = fmt::format("{:.6g}", value);
    double rounded = value;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    return rounded;
}

Json json(const PageCell& cell) {
    if (const auto* value = std::get_if<double>(&cell)) return number(*value);
    if (const auto* name = std::get_if<std::string>(&cell)) return *name;
    return nullptr;
}

const char* name_of(PageChart::Kind kind) {
    switch (kind) {
        case PageChart::Kind::Bars:
            return "bars";
        case PageChart::Kind::Stack:
            return "stack";
        case PageChart::Kind::Lines:
            return "lines";
        case PageChart::Kind::Points:
            return "points";
        case PageChart::Kind::Matrix:
            return "matrix";
    }
    return "";
}

Json json(const PageChart& chart) {
    Json object{{"kind", name_of(chart.kind)}, {"title", chart.title},
                {"note", chart.note},          {"x", chart.x},
                {"values", chart.values},      {"group", chart.group ? Json(*chart.group) : Json(nullptr)},
                {"y_title", chart.y_title},    {"x_log", chart.is_x_log},
                {"y_log", chart.is_y_log}};
    object["columns"] = Json::array();
    for (const PageColumn& column : chart.columns)
        object["columns"].push_back({{"name", column.name}, {"decimals", column.decimals}});
    object["rows"] = Json::array();
    for (const auto& cells : chart.rows) {
        Json& row = object["rows"].emplace_back(Json::array());
        for (const PageCell& cell : cells) row.push_back(json(cell));
    }
    return object;
}

Json json(const PageHeatMap& map) {
    Json mean = Json::array();
    for (const double value : map.mean) mean.push_back(number(value));
    return {{"title", map.title},   {"columns", map.columns}, {"rows", map.rows},
            {"pixels", map.pixels}, {"mean", mean},           {"greatest", map.greatest}};
}

Json json(const PageExplorer& explorer) {
    Json fields = Json::array();
    for (const PageField& field : explorer.fields) {
        Json& object = fields.emplace_back(
            Json{{"name", field.name}, {"better", field.better}, {"is_parameter", field.is_parameter}});
        if (!field.names.empty()) {
            object["names"] = field.names;
            continue;
        }
        object["numbers"] = Json::array();
        for (const auto& value : field.numbers)
            object["numbers"].push_back(value ? number(*value) : Json(nullptr));
    }
    return {{"fields", fields}, {"x", explorer.x}, {"y", explorer.y}, {"color", explorer.color}};
}

Json json(const PageFinding& finding) {
    return {{"subject", finding.subject},
            {"text", finding.text},
            {"advice", finding.advice},
            {"figures", finding.figures}};
}

template <class T>
Json array(const std::vector<T>& items) {
    Json result = Json::array();
    for (const T& item : items) result.push_back(json(item));
    return result;
}

}  // namespace

nlohmann::ordered_json page_json(const PageSection& section) {
    return {{"id", section.id},
            {"title", section.title},
            {"note", section.note},
            {"findings", array(section.findings)},
            {"charts", array(section.charts)},
            {"heat_maps", array(section.heat_maps)},
            {"explorer", section.explorer ? json(*section.explorer) : Json(nullptr)}};
}

}  // namespace rtu::study
