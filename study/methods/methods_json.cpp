#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "model/methods/operation_counts.hpp"
#include "study/json_output.hpp"
#include "study/methods/methods_text.hpp"

namespace rtu::study {

namespace {

using Json = nlohmann::ordered_json;

Json number(std::optional<double> value, double unit = 1) {
    return value ? Json(*value / unit) : Json(nullptr);
}

Json cycles(const MethodsReport& report, std::optional<double> per_second) {
    return per_second ? Json(report.clock_hz / *per_second) : Json(nullptr);
}

// Of a hit with t, u and v; of a pair, in both triangles. Null for a method that is no template.
Json operations(const MethodsRow& row) {
    using model::methods::Form;
    const auto* counts = model::methods::counts_of(row.kernel.method.name);
    const bool is_pair = row.kernel.form == Form::Pairs;
    Json object = Json::object();
    const bool is_known = counts != nullptr && (!is_pair || counts->pair);
    const model::methods::OperationCounts found = !is_known ? model::methods::OperationCounts{}
                                                  : is_pair ? counts->pair->both
                                                            : counts->single.hit;
    const auto set = [&](const char* name, std::uint32_t count) {
        object[name] = is_known ? Json(count) : Json(nullptr);
    };
    set("mul", found.mul);
    set("add", found.add);
    set("div", found.div);
    set("compare", found.compare);
    set("sign", found.sign);
    set("fma", found.fusable);
    return object;
}

// One list of names and values serves JSON and CSV.
Json row_json(const MethodsReport& report, const MethodsRow& row) {
    Json object{{"workload", row.workload},
                {"method", row.kernel.method.name},
                {"title", row.kernel.method.title},
                {"form", name_of(row.kernel.form)},
                {"width", row.kernel.width},
                {"stored_bytes", row.kernel.method.stored_bytes},
                {"tests", row.tests},
                {"hit_share", row.hit_share},
                {"mtests_per_second", row.tests_per_second / 1e6},
                {"first_pass_mtests_per_second", number(row.first_pass_tests_per_second, 1e6)},
                {"worst_mtests_per_second", number(row.worst_tests_per_second, 1e6)},
                {"precompute_mtriangles_per_second", number(row.precompute_triangles_per_second, 1e6)},
                {"cycles_per_test", cycles(report, row.tests_per_second)},
                {"worst_cycles_per_test", cycles(report, row.worst_tests_per_second)},
                {"ratio_to_wald", number(ratio_to_wald(report, row))}};
    object.update(operations(row));
    return object;
}

Json counts_json(const model::methods::OperationCounts& counts) {
    return {{"mul", counts.mul},         {"add", counts.add},   {"div", counts.div},
            {"compare", counts.compare}, {"sign", counts.sign}, {"fma", counts.fusable}};
}

Json operations_json() {
    Json array = Json::array();
    for (const model::methods::MethodCounts& counts : model::methods::operation_counts()) {
        Json object{{"method", counts.name},
                    {"precomputation", counts_json(counts.precomputation)},
                    {"rejected", counts_json(counts.single.rejected)},
                    {"miss", counts_json(counts.single.miss)},
                    {"full", counts_json(counts.single.full)},
                    {"hit", counts_json(counts.single.hit)}};
        if (counts.pair)
            object["pair"] = {{"rejected", counts_json(counts.pair->rejected)},
                              {"one_full", counts_json(counts.pair->one_full)},
                              {"both_full", counts_json(counts.pair->both_full)},
                              {"both", counts_json(counts.pair->both)}};
        array.push_back(object);
    }
    return array;
}

Json early_exits_json(const MethodsReport& report) {
    Json array = Json::array();
    for (const MethodsEarlyExits& row : report.early_exits)
        array.push_back({{"workload", row.workload},
                         {"tests", row.exits.tests},
                         {"by_both", row.exits.by_both},
                         {"by_distance_only", row.exits.by_distance_only},
                         {"by_aperture_only", row.exits.by_aperture_only},
                         {"hits", row.exits.hits}});
    return array;
}

Json scaling_json(const MethodsReport& report) {
    Json array = Json::array();
    for (const MethodsScalingRow& row : report.scaling)
        array.push_back({{"method", row.method},
                         {"tests", row.tests},
                         {"seconds", row.seconds},
                         {"mtests_per_second", double(row.tests) / row.seconds / 1e6}});
    return array;
}

Json published_json() {
    Json array = Json::array();
    for (const PublishedSpeed& speed : published_speeds())
        array.push_back({{"method", speed.method},
                         {"single_mtests_per_second", speed.single},
                         {"single_worst_mtests_per_second", speed.single_worst},
                         {"packets_mtests_per_second", number(speed.packets)},
                         {"packets_worst_mtests_per_second", number(speed.packets_worst)},
                         {"precompute_mtriangles_per_second", speed.precompute}});
    return {{"source", "Havel and Herout 2011, Tables I and II, Core 2 Duo E8200, Microsoft compiler"},
            {"rows", array}};
}

}  // namespace

std::string methods_json(const MethodsReport& report) {
    Json document{{"version", report.version},     {"instruction_set", report.instruction_set},
                  {"seed", report.seed},           {"triangle_count", report.triangle_count},
                  {"ray_count", report.ray_count}, {"repeats", report.repeats},
                  {"clock_hz", report.clock_hz}};
    document["rows"] = Json::array();
    for (const MethodsRow& row : report.rows) document["rows"].push_back(row_json(report, row));
    document["operations"] = operations_json();
    document["early_exits"] = early_exits_json(report);
    document["scaling"] = scaling_json(report);
    document["published"] = published_json();
    return json_text(document);
}

std::string methods_csv(const MethodsReport& report) {
    std::vector<Json> rows;
    for (const MethodsRow& row : report.rows) rows.push_back(row_json(report, row));
    return rows.empty() ? "" : json_rows_csv(rows.front(), rows);
}

}  // namespace rtu::study
