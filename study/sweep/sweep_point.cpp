#include "study/sweep/sweep_point.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/error.hpp"
#include "sim/machine.hpp"
#include "study/cpu_time.hpp"
#include "study/scene_steps.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

// "l1" of "rtu0.l1".
std::string_view kind_of(std::string_view unit_name) {
    return unit_name.substr(unit_name.rfind('.') + 1);  // npos + 1 is 0
}

// A counter, over all units of that kind.
std::uint64_t sum(const WorkloadReport& workload, std::string_view kind, std::string_view counter) {
    std::uint64_t result = 0;
    for (const auto* units : {&workload.units, &workload.memory}) {
        for (const UnitReport& unit : *units) {
            if (kind_of(unit.name) != kind) continue;
            for (const CounterValue& value : unit.counters) {
                if (value.name == counter) result += value.value;
            }
        }
    }
    return result;
}

template <std::uint64_t WorkloadReport::*Count>
std::uint64_t field(const WorkloadReport& workload) {
    return workload.*Count;
}

constexpr std::array counts = std::to_array<SweepCount>({
    {"ray_count", "rays", "rays handed to the machine", field<&WorkloadReport::ray_count>},
    {"hit_count", "rays", "rays with a hit", field<&WorkloadReport::hit_count>},
    {"node_visits", "nodes", "inner nodes fetched and tested", field<&WorkloadReport::node_visits>},
    {"box_tests", "tests", "ray-box tests", field<&WorkloadReport::box_tests>},
    {"pair_tests", "tests", "pairs and lone triangles tested", field<&WorkloadReport::pair_tests>},
    {"triangle_tests", "tests", "triangles in them", field<&WorkloadReport::triangle_tests>},
    {"cycles", "cycles", "first ray offered to last hit taken", field<&WorkloadReport::cycles>},
    {"slot_cycles", "cycles", "cycles that ray slots were held, over all slots",
     [](const WorkloadReport& w) { return sum(w, "scheduler", "slot_cycles"); }},
    {"spilled_entries", "entries", "stack entries written to memory",
     [](const WorkloadReport& w) { return sum(w, "scheduler", "spilled_entries"); }},
    {"pair_tester_cycles", "cycles", "cycles that pair testers were held, over all testers",
     [](const WorkloadReport& w) { return sum(w, "pair", "tester_cycles"); }},
    {"pair_replays", "replays", "pairs that needed the exact pass twice",
     [](const WorkloadReport& w) { return sum(w, "pair", "replays"); }},
    {"l1_line_reads", "accesses", "line accesses of the L1s",
     [](const WorkloadReport& w) { return sum(w, "l1", "line_reads"); }},
    {"l1_hits", "accesses", "of those, hits", [](const WorkloadReport& w) { return sum(w, "l1", "hits"); }},
    {"l2_line_reads", "accesses", "line accesses of the L2",
     [](const WorkloadReport& w) { return sum(w, "l2", "line_reads"); }},
    {"l2_hits", "accesses", "of those, hits", [](const WorkloadReport& w) { return sum(w, "l2", "hits"); }},
    {"dram_row_hits", "requests", "DRAM requests that found their row open",
     [](const WorkloadReport& w) { return sum(w, "dram", "row_hits"); }},
    {"dram_read_bytes", "bytes", "read from DRAM",
     [](const WorkloadReport& w) { return sum(w, "dram", "read_bytes"); }},
    {"dram_write_bytes", "bytes", "written to DRAM",
     [](const WorkloadReport& w) { return sum(w, "dram", "write_bytes"); }},
    {"box_hits", "tests", "of those, boxes that the ray enters",
     [](const WorkloadReport& w) { return sum(w, "box", "box_hits"); }},
    {"extra_box_hits", "tests", "of those, entered because of quantisation only",
     [](const WorkloadReport& w) { return sum(w, "box", "extra_box_hits"); }},
    {"node_fetch_bytes", "bytes", "of the nodes asked for",
     [](const WorkloadReport& w) { return sum(w, "scheduler", "node_fetch_bytes"); }},
});

constexpr std::size_t index_of(std::string_view name) {
    return std::size_t(std::ranges::find(counts, name, &SweepCount::name) - counts.begin());
}
constexpr std::size_t ray_count_index = index_of("ray_count"), cycles_index = index_of("cycles");
static_assert(ray_count_index < counts.size() && cycles_index < counts.size());

SweepRow row_of(const WorkloadReport& workload) {
    SweepRow row{workload.name, "cycle", double(workload.cycles), double(workload.cycles)};
    for (const SweepCount& count : counts) row.counts.emplace_back(count.value(workload));
    return row;
}

// Cycles are whole, so that the interval may have to reach a fraction further.
SweepRow row_of(const std::string& workload, const LevelResult& result) {
    const CycleEstimate& estimate = result.estimate;
    const double cycles = std::round(estimate.cycles_per_ray * estimate.rays);
    SweepRow row{workload, result.level, std::min(cycles, estimate.low * estimate.rays)};
    if (std::isfinite(estimate.high)) row.cycles_high = std::max(cycles, estimate.high * estimate.rays);
    if (result.level == to_string(FidelityLevel::Cycle)) {
        row.cycles_low = cycles;
        row.cycles_high = cycles;
    }
    row.counts.resize(counts.size());
    row.counts[ray_count_index] = std::uint64_t(std::llround(estimate.rays));
    row.counts[cycles_index] = std::uint64_t(cycles);
    return row;
}

std::optional<std::uint64_t> sum(std::optional<std::uint64_t> a, std::optional<std::uint64_t> b) {
    return a && b ? std::optional(*a + *b) : std::nullopt;
}

// The bounds are added, as if the errors of all workloads had one cause.
SweepRow total_of(const std::vector<SweepRow>& rows) {
    SweepRow total{"total", "cycle", 0, 0.0};
    total.counts.assign(counts.size(), 0);
    for (const SweepRow& row : rows) {
        total.level = std::string(
            to_string(std::min(parse_fidelity_level(total.level), parse_fidelity_level(row.level))));
        total.cycles_low += row.cycles_low;
        total.cycles_high = total.cycles_high && row.cycles_high
                                ? std::optional(*total.cycles_high + *row.cycles_high)
                                : std::nullopt;
        for (std::size_t i = 0; i < counts.size(); ++i) total.counts[i] = sum(total.counts[i], row.counts[i]);
    }
    return total;
}

}  // namespace

std::span<const SweepCount> sweep_counts() { return counts; }

SweepResult simulate_point(const std::string& point, const sim::Config& config, const SweepTree& tree) {
    SweepResult result;
    result.point = point;
    result.paired_percent = tree.paired_percent();
    const double start = cpu_seconds();
    WorkloadStream rays(tree.chunks());
    while (rays.next_workload()) {
        const std::string name = rays.name();
        std::uint64_t hit_count = 0;
        const sim::MachineResult simulated = sim::simulate(
            config, tree.image(), rays, rays.kind(),
            [&](const std::optional<model::Hit>& hit) { hit_count += hit.has_value() ? 1 : 0; });
        result.rows.push_back(row_of(workload_report(name, hit_count, simulated)));
    }
    result.rows.push_back(total_of(result.rows));
    result.cpu_seconds = cpu_seconds() - start;
    return result;
}

SweepResult estimate_point(const std::string& point, const sim::Config& config, const SweepTree& tree,
                           FidelityLevel level, const SampledOptions& options) {
    SweepResult result;
    result.point = point;
    result.paired_percent = tree.paired_percent();
    const double start = cpu_seconds();
    for (const auto& population : tree.populations()) {
        const LevelResult found = run_level(level, config, tree.image(), *population, options);
        result.rows.push_back(row_of(population->name(), found));
    }
    result.rows.push_back(total_of(result.rows));
    result.cpu_seconds = cpu_seconds() - start;
    return result;
}

std::string to_json_line(const SweepResult& result) {
    Json rows = Json::object();
    for (const SweepRow& row : result.rows) {
        Json counts_of_row = Json::array();
        for (const auto& count : row.counts) counts_of_row.push_back(count ? Json(*count) : Json());
        rows[row.workload] = {{"level", row.level},
                              {"low", row.cycles_low},
                              {"high", row.cycles_high ? Json(*row.cycles_high) : Json()},
                              {"counts", std::move(counts_of_row)}};
    }
    const Json line{{"point", result.point},
                    {"error", result.error},
                    {"paired_percent", result.paired_percent},
                    {"rows", rows},
                    {"cpu_seconds", result.cpu_seconds}};
    return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

SweepResult parse_sweep_result(std::string_view line) try {
    const Json json = Json::parse(line);
    SweepResult result;
    result.point = json.at("point");
    result.error = json.at("error");
    result.paired_percent = json.at("paired_percent");
    result.cpu_seconds = json.at("cpu_seconds");
    for (const auto& [workload, values] : json.at("rows").items()) {
        SweepRow row{workload, values.at("level"), values.at("low")};
        if (!values.at("high").is_null()) row.cycles_high = values.at("high").get<double>();
        for (const Json& count : values.at("counts")) {
            row.counts.push_back(count.is_null() ? std::nullopt : std::optional(count.get<std::uint64_t>()));
        }
        if (row.counts.size() != counts.size()) throw Error("expected {} counts", counts.size());
        result.rows.push_back(std::move(row));
    }
    return result;
} catch (const Json::exception& error) {
    throw Error("expected the result of a point: {}", error.what());
}

}  // namespace rtu::study
