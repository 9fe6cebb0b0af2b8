#include "study/pairing/pairing_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "study/json_output.hpp"
#include "study/pairing/pairing_study.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

Json json(std::optional<double> value) { return value ? Json(*value) : Json(nullptr); }

Json json(const PairingRun& run) {
    Json uses = Json::object();
    for (const PartUse& use : run.uses) uses[use.part] = use.percent;
    const PartUse& bound = busiest(run.uses);
    return {{"pairing_seconds", run.pairing.seconds},
            {"paired_percent", run.pairing.paired_percent},
            {"pair_count", run.pairing.pair_count},
            {"single_count", run.pairing.single_count},
            {"image_bytes", run.bvh.image_bytes},
            {"bvh_build_seconds", run.bvh.build_seconds},
            {"bvh_width", run.bvh.width},
            {"ray_count", run.total.ray_count},
            {"hit_count", run.total.hit_count},
            {"node_visits", run.total.node_visits},
            {"box_tests", run.total.box_tests},
            {"pair_tests", run.total.pair_tests},
            {"triangle_tests", run.total.triangle_tests},
            {"cycles", run.total.cycles},
            {"clock_mhz", run.clock_mhz},
            {"mrps", run.mrps()},
            {"l1_misses", run.l1_misses},
            {"l2_misses", run.l2_misses},
            {"dram_bytes", run.dram_bytes},
            {"bound_by", bound.part},
            {"bound_percent", bound.percent},
            {"use_percent", uses}};
}

Json published_json(const PairingRow& row) {
    if (row.published == nullptr) return nullptr;
    return {
        {"seconds", json(row.published->seconds)},
        {"old_paired_percent", row.published->old_paired_percent},
        {"new_paired_percent", row.published->new_paired_percent},
        {"delta_box_percent", row.published->delta_box_percent},
        {"delta_tri_percent", row.published->delta_tri_percent},
        {"delta_mrps_percent", row.published->delta_mrps_percent},
        {"is_papers_mesh", row.mesh.is_papers_mesh},
        {"mesh", row.mesh.note},
        {"source", "A. Aman, S. Fenney, Fast Triangle Pairing for Ray Tracing, Imagination Technologies"}};
}

Json json(const model::CompressionCost& cost) {
    return {{"exact_candidates", cost.exact_candidates}, {"candidates", cost.candidates},
            {"wrong_candidates", cost.wrong_candidates}, {"lost_candidates", cost.lost_candidates},
            {"exact_pairs", cost.exact_pairs},           {"pairs", cost.pairs}};
}

Json json(const PairingRow& row) {
    Json object{{"scene", row.scene}, {"method", row.method}, {"baseline", row.baseline}};
    for (const PairingColumn& column : pairing_columns()) object[column.key] = json(column.value(row));
    object["old"] = json(row.before);
    object["new"] = json(row.after);
    object["published"] = published_json(row);
    object["compression"] = row.compression ? json(*row.compression) : Json(nullptr);
    return object;
}

Json averages(const PairingReport& report) {
    Json array = Json::array();
    for (const std::string& method : report.methods) {
        Json object{{"method", method}, {"baseline", report.baseline}};
        for (const PairingColumn& column : pairing_columns()) {
            object[column.key] = json(average(report.rows, method, column));
        }
        array.push_back(object);
    }
    return array;
}

Json json(const PairingStudyTable& study) {
    const PairingStudyInfo& what = info(study.kind);
    Json rows = Json::array();
    for (const PairingPoint& point : study.points) {
        Json object{{"setting", point.setting}, {"x", json(point.x)}};
        object.update(json(point.row));
        rows.push_back(object);
    }
    return {{"name", what.name}, {"meaning", what.meaning}, {"axis", what.axis}, {"rows", rows}};
}

Json scenes(const PairingReport& report) {
    Json array = Json::array();
    for (const PairingScene& scene : report.scenes) {
        array.push_back({{"name", scene.facts.name},
                         {"triangle_count", scene.facts.triangle_count},
                         {"vertex_count", scene.facts.vertex_count},
                         {"degenerate_count", scene.facts.degenerate_count},
                         {"input_hash", scene.input_hash},
                         {"camera_source", scene.camera_source},
                         {"prescan",
                          {{"is_well_paired", scene.prescan.is_well_paired},
                           {"scanned_triangles", scene.prescan.scanned_triangles},
                           {"lone_triangles", scene.prescan.lone_triangles}}}});
    }
    return array;
}

Json config(const PairingReport& report) {
    Json object = Json::object();
    for (const auto& [key, value] : report.config) {
        std::visit([&, name = key](const auto& v) { object[name] = v; }, value);
    }
    return object;
}

}  // namespace

std::string pairing_json(const PairingReport& report) {
    Json document{{"version", report.version},
                  {"preset", report.preset},
                  {"config_hash", report.config_hash},
                  {"seed", report.seed},
                  {"resolution", {{"width", report.resolution.width}, {"height", report.resolution.height}}},
                  {"workloads", report.workloads},
                  {"edge_identity", report.edge_identity},
                  {"baseline", report.baseline},
                  {"methods", report.methods},
                  {"rotation_degrees", report.rotation},
                  {"scenes", scenes(report)},
                  {"config", config(report)}};
    document["rows"] = Json::array();
    for (const PairingRow& row : report.rows) document["rows"].push_back(json(row));
    document["averages"] = averages(report);
    document["average"] = document["averages"].front();  // of the first method
    document["studies"] = Json::array();
    for (const PairingStudyTable& study : report.studies) document["studies"].push_back(json(study));
    return json_text(document);
}

}  // namespace rtu::study
