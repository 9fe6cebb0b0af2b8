#include "study/report/run_findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "sim/config_keys.hpp"
#include "study/pairing/pairing_run.hpp"
#include "study/report/run_waits.hpp"
#include "study/text_table.hpp"

namespace rtu::study {
namespace {

// What a part of part_uses() is called, and what makes it faster.
struct PartText {
    std::string_view part, name, more, key;
};

constexpr std::array parts{
    PartText{"host", "the host that hands rays over", "more rays a cycle", "host.rays_per_cycle"},
    PartText{"scheduler", "the scheduler", "more fetches a cycle", "rtu.fetches_per_cycle"},
    PartText{"box", "the box unit", "more box lanes", "rtu.box.boxes_per_cycle"},
    PartText{"pair", "the first pass of the pair unit", "more pair testers", "rtu.pair.testers"},
    PartText{"hit", "the pair unit's hit units", "more hit units", "rtu.pair.hit_units"},
    PartText{"l1", "the L1", "more banks", "l1.banks"},
    PartText{"l2", "the L2", "more banks", "l2.banks"},
    PartText{"dram", "the DRAM bus", "more channels, or a larger L2", "dram.channels"},
};

PartText text_of(std::string_view part, const sim::Config& config) {
    if (part == "dram" && config.memory.model == sim::MemoryModel::Flat)
        return {part, "the memory", "more bytes a cycle, or a larger L1", "memory.bytes_per_cycle"};
    return *std::ranges::find(parts, part, &PartText::part);
}

std::string now(std::string_view key, const sim::Config& config) {
    const sim::ConfigKey& row = sim::config_keys()[sim::config_key_index(key, key)];
    return fmt::format("{}, now {}", key, sim::config_value_text(config, row));
}

// A workload with what its counters come to.
struct RunCase {
    const WorkloadReport* workload = nullptr;
    std::vector<PartUse> uses;
    RunWaits waits;
};
using RunCases = std::vector<RunCase>;

std::string figures_of(const RunCase& one) {
    std::vector<std::string> used;
    for (const PartUse& use : one.uses) used.push_back(fmt::format("{} {:.1f}", use.part, use.percent));
    return fmt::format(
        "{}: in use, % of cycles: {}; ray slots taken {:.1f} of {}; waits, % of cycles: L1 banks {:.1f}, L1 "
        "MSHRs {:.1f}, pair unit blocked {:.1f}",
        one.workload->name, fmt::join(used, ", "), one.waits.slots_taken, one.waits.slots,
        one.waits.banks_percent, one.waits.mshrs_percent, one.waits.pair_blocked_percent);
}

// "97 %", or of several workloads "97 % (primary), 91 % (shadow)".
template <class Value>
std::string each(const RunCases& cases, std::string_view unit, Value value) {
    std::vector<std::string> texts;
    for (const RunCase& one : cases) {
        const std::string text = fmt::format("{:.0f} {}", value(one), unit);
        texts.push_back(cases.size() == 1 ? text : fmt::format("{} ({})", text, one.workload->name));
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

std::string slots_of(const RunCases& cases) {
    return each(cases, "%", [](const RunCase& one) { return one.waits.slots_percent(); });
}

// Of full parts: no relief of one of them can gain more than until the next one is full.
std::string part_advice(const RunCases& cases, const sim::Config& config) {
    const PartText text = text_of(busiest(cases.front().uses).part, config);
    double gain = 0;
    std::string_view next;
    for (const RunCase& one : cases) {
        std::vector<PartUse> order = one.uses;
        std::ranges::stable_sort(order, std::ranges::greater(), &PartUse::percent);
        const double ratio = order[1].percent > 0 ? order[0].percent / order[1].percent : 0;
        if (ratio > gain) {
            gain = ratio;
            next = text_of(order[1].part, config).name;
        }
    }
    std::string change = fmt::format("Change: {} ({}).", text.more, now(text.key, config));
    if (gain == 0) return change;
    return fmt::format("{} It gives at most {:.2f} times the rate: then {} would be full.", change, gain,
                       next);
}

void describe_full(RunLimit limit, const RunCases& cases, const sim::Config& config, PageFinding& found) {
    if (limit == RunLimit::Part) {
        found.text =
            fmt::format("The limit is {}: {} of what it can do is used.",
                        text_of(busiest(cases.front().uses).part, config).name,
                        each(cases, "%", [](const RunCase& one) { return busiest(one.uses).percent; }));
        found.advice = part_advice(cases, config);
    } else {
        found.text =
            fmt::format("The host link is the limit. Cycles in which no batch was in the machine: {}.",
                        each(cases, "%", [](const RunCase& one) { return one.waits.link_percent; }));
        found.advice =
            fmt::format("Change: a faster link (--link), larger batches ({}) or more of them under way ({}).",
                        now("link.batch_rays", config), now("link.buffers", config));
    }
}

// Nothing is full.
void describe_waits(RunLimit limit, const RunCases& cases, const sim::Config& config, PageFinding& found) {
    const std::string nothing = fmt::format(
        "No part is full: the busiest one is used {}. Ray slots taken: {}.",
        each(cases, "%", [](const RunCase& one) { return busiest(one.uses).percent; }), slots_of(cases));
    if (limit == RunLimit::TooFewRays) {
        found.text = nothing + " Rays are missing.";
        found.advice = fmt::format(
            "Change: trace more rays, since the machine is half empty while the first come and the last "
            "leave; or hand them over faster ({}).",
            now("host.rays_per_cycle", config));
    } else if (limit == RunLimit::Banks) {
        found.text = nothing + " Requests queue for the banks of the L1.";
        found.advice = fmt::format("Change: more banks ({}).", now("l1.banks", config));
    } else if (limit == RunLimit::Mshrs) {
        found.text = nothing + " Misses queue for the MSHRs of the L1.";
        found.advice = fmt::format("Change: more MSHRs ({}) or targets of each ({}).",
                                   now("l1.mshrs", config), now("l1.targets_per_mshr", config));
    } else if (limit == RunLimit::PairEntries) {
        found.text = fmt::format(
            "{} Leaves queue for the pair unit, and survivors of its first pass wait for a hit unit: {}.",
            nothing, each(cases, "cycles", [](const RunCase& one) { return one.waits.hit_wait_cycles; }));
        found.advice = fmt::format("Change: more hit units ({}) and entries ({}).",
                                   now("rtu.pair.hit_units", config), now("rtu.pair.entries", config));
    } else {
        found.text =
            fmt::format("{} Rays wait for latencies. Reads that miss the L1: {}.", nothing,
                        each(cases, "%", [](const RunCase& one) { return one.waits.l1_miss_percent; }));
        found.advice = fmt::format(
            "Try: a larger L1 ({}), or more rays in flight ({}), which also makes them share the caches.",
            now("l1.size_bytes", config), now("rtu.ray_slots", config));
    }
}

PageFinding described(RunLimit limit, const RunCases& cases, const sim::Config& config) {
    PageFinding found;
    std::vector<std::string> names, figures;
    for (const RunCase& one : cases) {
        names.push_back(one.workload->name);
        figures.push_back(figures_of(one));
    }
    found.subject = fmt::format("{}", fmt::join(names, ", "));
    if (limit == RunLimit::NoWork) {
        found.text = "There was no ray to trace.";
        return found;
    }
    found.figures = fmt::format("{}", fmt::join(figures, "\n"));
    if (limit == RunLimit::Part || limit == RunLimit::Link) {
        describe_full(limit, cases, config, found);
    } else {
        describe_waits(limit, cases, config, found);
    }
    return found;
}

// Workloads with the same limit are one finding.
std::vector<PageFinding> limits(const SceneReport& report, const sim::Config& config) {
    std::map<std::pair<RunLimit, std::string>, RunCases> cases;
    for (const WorkloadReport& workload : report.workloads) {
        RunCase one{&workload, part_uses(std::span(&workload, 1), config), run_waits(workload, config)};
        const RunLimit limit = limit_of(workload, config);
        cases[{limit, limit == RunLimit::Part ? busiest(one.uses).part : ""}].push_back(std::move(one));
    }
    std::vector<PageFinding> findings;
    findings.reserve(cases.size());
    for (const auto& [limit, same] : cases) findings.push_back(described(limit.first, same, config));
    return findings;
}

void add_stack(std::vector<PageFinding>& findings, const SceneReport& report, const sim::Config& config) {
    std::uint64_t spilled = 0, visits = 0;
    for (const WorkloadReport& workload : report.workloads) {
        spilled += run_waits(workload, config).spilled_entries;
        visits += workload.node_visits;
    }
    if (spilled * 100 <= visits) return;
    findings.push_back(
        {report.scene.name, "The traversal stacks overflow into memory.",
         fmt::format("Change: more stack entries ({}).", now("rtu.stack_entries", config)),
         fmt::format("{} entries written for {} nodes visited", grouped(spilled), grouped(visits))});
}

void add_pairing(std::vector<PageFinding>& findings, const SceneReport& report) {
    constexpr double few_percent = 70;
    if (report.pairing.paired_percent >= few_percent) return;
    const bool is_by_index = report.pairing.edge_identity == "index";
    findings.push_back(
        {report.scene.name,
         fmt::format("Only {:.0f} % of the triangles are in pairs: the pair unit tests many alone.",
                     report.pairing.paired_percent),
         is_by_index ? "Change: let corners be one vertex by position (--edge-identity position)."
         : report.pairing.method == "edge_bbsa" ? std::string()
                                                : "Change: another pairing (--pairing edge_bbsa).",
         fmt::format("{}, by {}: {} pairs, {} lone triangles", report.pairing.method,
                     report.pairing.edge_identity, grouped(report.pairing.pair_count),
                     grouped(report.pairing.single_count))});
}

void add_check(std::vector<PageFinding>& findings, const SceneReport& report) {
    if (!report.check || report.check->is_clean()) return;
    findings.push_back(
        {report.scene.name,
         "The check failed: simulated hits are wrong.",
         {},
         fmt::format("{} of {} hits differ from the reference, {} of {} from Embree",
                     grouped(report.check->mismatches), grouped(report.check->compared),
                     grouped(report.check->embree_mismatches), grouped(report.check->embree_compared))});
}

}  // namespace

RunLimit limit_of(const WorkloadReport& workload, const sim::Config& config) {
    if (workload.ray_count == 0 || workload.cycles == 0) return RunLimit::NoWork;
    const std::vector<PartUse> uses = part_uses(std::span(&workload, 1), config);
    if (busiest(uses).percent >= full_percent) return RunLimit::Part;
    const RunWaits waits = run_waits(workload, config);
    if (waits.link_percent >= 50) return RunLimit::Link;
    if (waits.pair_blocked_percent >= 20) return RunLimit::PairEntries;
    if (waits.mshrs_percent >= 10) return RunLimit::Mshrs;
    if (waits.banks_percent >= 40) return RunLimit::Banks;
    return waits.slots_percent() < 90 ? RunLimit::TooFewRays : RunLimit::Latency;
}

std::vector<PageFinding> run_findings(const SceneReport& report, const sim::Config& config) {
    std::vector<PageFinding> findings = limits(report, config);
    for (PageFinding& found : findings) found.subject = report.scene.name + ": " + found.subject;
    add_stack(findings, report, config);
    add_pairing(findings, report);
    add_check(findings, report);
    return findings;
}

}  // namespace rtu::study
