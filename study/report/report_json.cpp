#include "study/report/report_json.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "study/json_output.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

// The binary64 that prints as the binary32 does: 0.45, not 0.44999998807907104.
double shortest(float value) {
    const std::string text = fmt::format("{}", value);
    double result = value;
    std::from_chars(text.data(), text.data() + text.size(), result);
    return result;
}

Json json(model::Vec3 v) { return Json::array({shortest(v.x), shortest(v.y), shortest(v.z)}); }

Json json(const std::vector<CounterValue>& counters) {
    Json object = Json::object();
    for (const CounterValue& counter : counters) object[counter.name] = counter.value;
    return object;
}

// Of every unit, memory included: its cycles.
Json units(const WorkloadReport& workload) {
    Json object = Json::object();
    for (const auto* list : {&workload.units, &workload.memory}) {
        for (const auto& [name, cycles, counters] : *list) {
            object[name] = {{"busy", cycles.busy},
                            {"starved", cycles.starved},
                            {"blocked", cycles.blocked},
                            {"idle", cycles.idle}};
        }
    }
    for (const UnitReport& unit : workload.units) object[unit.name]["counters"] = json(unit.counters);
    return object;
}

Json memory(const WorkloadReport& workload) {
    Json object = Json::object();
    for (const UnitReport& level : workload.memory) object[level.name] = json(level.counters);
    return object;
}

Json counts(const WorkloadReport& workload, std::uint32_t clock_mhz) {
    return {
        {"ray_count", workload.ray_count},   {"hit_count", workload.hit_count},
        {"box_tests", workload.box_tests},   {"node_visits", workload.node_visits},
        {"pair_tests", workload.pair_tests}, {"triangle_tests", workload.triangle_tests},
        {"cycles", workload.cycles},         {"mrps", mrps(workload.ray_count, workload.cycles, clock_mhz)}};
}

Json workloads(const SceneReport& report) {
    Json array = Json::array();
    for (const WorkloadReport& workload : report.workloads) {
        Json object{{"name", workload.name}};
        object.update(counts(workload, report.clock_mhz));
        object["units"] = units(workload);
        object["memory"] = memory(workload);
        array.push_back(object);
    }
    return array;
}

Json config(const SceneReport& report) {
    Json object{{"clock_mhz", report.clock_mhz}};
    for (const auto& [key, value] : report.config) {
        std::visit([&, name = key](const auto& v) { object[name] = v; }, value);
    }
    return object;
}

Json run(const SceneReport& report) {
    return {{"version", report.version},
            {"preset", report.preset},
            {"input_hash", report.input_hash},
            {"config_hash", config_hash(report)},
            {"seed", report.seed},
            {"resolution", {{"width", report.resolution.width}, {"height", report.resolution.height}}},
            {"camera",
             {{"source", report.camera_source},
              {"eye", json(report.camera.eye)},
              {"target", json(report.camera.target)},
              {"up", json(report.camera.up)},
              {"tan_half_fov", shortest(report.camera.tan_half_fov)}}}};
}

Json inputs(const SceneReport& report) {
    Json all{{"scene",
              {{"name", report.scene.name},
               {"triangle_count", report.scene.triangle_count},
               {"vertex_count", report.scene.vertex_count},
               {"degenerate_count", report.scene.degenerate_count}}},
             {"pairing",
              {{"method", report.pairing.method},
               {"edge_identity", report.pairing.edge_identity},
               {"paired_percent", report.pairing.paired_percent},
               {"pair_count", report.pairing.pair_count},
               {"single_count", report.pairing.single_count},
               {"seconds", report.pairing.seconds}}},
             {"bvh",
              {{"width", report.bvh.width},
               {"node_format", report.bvh.node_format},
               {"node_bytes", report.bvh.node_bytes},
               {"node_count", report.bvh.node_count},
               {"leaf_count", report.bvh.leaf_count},
               {"image_bytes", report.bvh.image_bytes},
               {"build_seconds", report.bvh.build_seconds}}}};
    if (report.bvh.extra_leaf_count > 0) all["bvh"]["extra_leaf_count"] = report.bvh.extra_leaf_count;
    return all;
}

Json json(const HostFacts& host) {
    return {{"cpu_seconds", host.cpu_seconds},
            {"total_cpu_seconds", host.total_cpu_seconds},
            {"simulated_rays_per_second", simulated_rays_per_second(host)},
            {"peak_rss_bytes", host.peak_rss_bytes}};
}

Json json(const CheckReport& check) {
    return {{"compared", check.compared},
            {"mismatches", check.mismatches},
            {"embree_compared", check.embree_compared},
            {"embree_mismatches", check.embree_mismatches},
            {"embree_wrong", check.embree_wrong},
            {"both_wrong", check.both_wrong},
            {"ties", check.ties}};
}

Json json(const SceneReport& report) {
    Json object = run(report);
    object.update(inputs(report));
    if (report.rays_file) object["rays_file"] = *report.rays_file;
    object["config"] = config(report);
    object["workloads"] = workloads(report);
    object["total"] = counts(total(report), report.clock_mhz);
    object["host"] = json(report.host);
    object["check"] = json(report.check.value_or(CheckReport{}));
    return object;
}

}  // namespace

std::string json_report(std::span<const SceneReport> reports) {
    Json document = Json::array();
    for (const SceneReport& report : reports) document.push_back(json(report));
    if (document.size() == 1) document = Json(document.front());
    return json_text(document);
}

}  // namespace rtu::study
