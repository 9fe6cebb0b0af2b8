#include "study/report/run_report.hpp"

#include <fmt/format.h>

#include "model/fingerprint.hpp"
#include "sim/config_keys.hpp"

namespace rtu::study {

std::vector<ConfigEntry> config_entries(const sim::Config& config) {
    std::vector<ConfigEntry> entries;
    for (const sim::ConfigKey& key : sim::config_keys()) {
        const sim::ConfigValue value = sim::config_value(config, key);
        if (const auto* number = std::get_if<std::uint32_t>(&value)) {
            entries.push_back({std::string(key.name), std::uint64_t{*number}});
        } else {
            entries.push_back({std::string(key.name), std::string(std::get<std::string_view>(value))});
        }
    }
    return entries;
}

WorkloadReport total(const SceneReport& report) {
    WorkloadReport sum;
    sum.name = "total";
    for (const WorkloadReport& workload : report.workloads) {
        sum.ray_count += workload.ray_count;
        sum.hit_count += workload.hit_count;
        sum.box_tests += workload.box_tests;
        sum.node_visits += workload.node_visits;
        sum.pair_tests += workload.pair_tests;
        sum.triangle_tests += workload.triangle_tests;
        sum.cycles += workload.cycles;
    }
    return sum;
}

std::string config_hash(const SceneReport& report) {
    std::string text;
    for (const auto& [key, value] : report.config) {
        std::visit([&text, name = key](const auto& v) { text += fmt::format("{}={}\n", name, v); }, value);
    }
    return model::hex_digits(model::fingerprint(text));
}

}  // namespace rtu::study
