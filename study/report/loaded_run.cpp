#include "study/report/loaded_run.hpp"

#include <nlohmann/json.hpp>

#include "sim/effective_config.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t count(const Json& json, const char* name) { return json.at(name).get<std::uint64_t>(); }
std::string text(const Json& json, const char* name) { return json.at(name).get<std::string>(); }

// Units of measure are not in the JSON; no reader of a loaded report needs them.
std::vector<CounterValue> counters(const Json& json) {
    std::vector<CounterValue> result;
    for (const auto& [name, value] : json.items()) result.push_back({name, {}, value.get<std::uint64_t>()});
    return result;
}

WorkloadReport workload(const Json& json) {
    WorkloadReport result;
    result.name = text(json, "name");
    result.ray_count = count(json, "ray_count");
    result.hit_count = count(json, "hit_count");
    result.box_tests = count(json, "box_tests");
    result.node_visits = count(json, "node_visits");
    result.pair_tests = count(json, "pair_tests");
    result.triangle_tests = count(json, "triangle_tests");
    result.cycles = count(json, "cycles");
    const Json& memory = json.at("memory");
    for (const auto& [name, unit] : json.at("units").items()) {
        const sim::CycleAccount cycles{count(unit, "busy"), count(unit, "starved"), count(unit, "blocked"),
                                       count(unit, "idle")};
        if (memory.contains(name)) {
            result.memory.push_back({name, cycles, counters(memory.at(name))});
        } else {
            result.units.push_back({name, cycles, counters(unit.at("counters"))});
        }
    }
    return result;
}

std::vector<ConfigEntry> config(const Json& json) {
    std::vector<ConfigEntry> entries;
    for (const auto& [key, value] : json.items()) {
        if (value.is_string()) {
            entries.push_back({key, value.get<std::string>()});
        } else {
            entries.push_back({key, value.get<std::uint64_t>()});
        }
    }
    return entries;
}

CheckReport check(const Json& json) {
    return {count(json, "compared"),
            count(json, "mismatches"),
            count(json, "embree_compared"),
            count(json, "embree_mismatches"),
            count(json, "embree_wrong"),
            count(json, "both_wrong"),
            count(json, "ties")};
}

void read_scene(const Json& json, SceneReport& report) {
    const Json& scene = json.at("scene");
    report.scene = {text(scene, "name"), count(scene, "triangle_count"), count(scene, "vertex_count"),
                    count(scene, "degenerate_count")};
    const Json& pairing = json.at("pairing");
    report.pairing = {text(pairing, "method"),
                      text(pairing, "edge_identity"),
                      pairing.at("paired_percent").get<double>(),
                      count(pairing, "pair_count"),
                      count(pairing, "single_count"),
                      0};
    const Json& bvh = json.at("bvh");
    report.bvh = {std::uint32_t(count(bvh, "width")),
                  text(bvh, "node_format"),
                  count(bvh, "node_bytes"),
                  count(bvh, "node_count"),
                  count(bvh, "leaf_count"),
                  count(bvh, "image_bytes"),
                  0,
                  bvh.contains("extra_leaf_count") ? count(bvh, "extra_leaf_count") : 0};
}

}  // namespace

SceneReport report_of_json(const Json& json) {
    SceneReport report;
    report.version = text(json, "version");
    report.input_hash = text(json, "input_hash");
    report.preset = text(json, "preset");
    report.seed = count(json, "seed");
    report.resolution = {std::uint32_t(count(json.at("resolution"), "width")),
                         std::uint32_t(count(json.at("resolution"), "height"))};
    report.camera_source = text(json.at("camera"), "source");
    if (json.contains("rays_file")) report.rays_file = text(json, "rays_file");
    read_scene(json, report);
    report.config = config(json.at("config"));
    report.clock_mhz = std::uint32_t(count(json.at("config"), "clock_mhz"));
    for (const Json& one : json.at("workloads")) report.workloads.push_back(workload(one));
    const CheckReport checked = check(json.at("check"));
    if (checked.compared > 0) report.check = checked;
    return report;
}

sim::Config machine_of(const SceneReport& report, const std::string& place) {
    sim::EffectiveConfig machine = sim::default_config();
    for (const auto& [key, value] : report.config) {
        sim::ConfigAssignment assignment{key, {}, {}, place};
        if (const auto* number = std::get_if<std::uint64_t>(&value)) {
            assignment.value = std::int64_t(*number);
        } else {
            assignment.value = std::get<std::string>(value);
        }
        machine = sim::assign(std::move(machine), assignment);
    }
    return machine.config;
}

}  // namespace rtu::study
