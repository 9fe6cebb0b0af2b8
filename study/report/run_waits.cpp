#include "study/report/run_waits.hpp"

#include <algorithm>
#include <string_view>

namespace rtu::study {
namespace {

// "l1" and "rtu0.l1" are of kind "l1".
bool is_of_kind(std::string_view unit, std::string_view kind) {
    return unit.substr(unit.rfind('.') + 1) == kind;
}

struct KindSum {
    const WorkloadReport& workload;
    std::string_view kind;

    template <class Value>
    [[nodiscard]] std::uint64_t over_units(Value value) const {
        std::uint64_t sum = 0;
        for (const auto* units : {&workload.units, &workload.memory}) {
            for (const UnitReport& unit : *units) sum += is_of_kind(unit.name, kind) ? value(unit) : 0;
        }
        return sum;
    }
    [[nodiscard]] double of(std::string_view counter) const {
        return double(over_units([&](const UnitReport& unit) {
            const auto found = std::ranges::find(unit.counters, counter, &CounterValue::name);
            return found == unit.counters.end() ? 0 : found->value;
        }));
    }
    [[nodiscard]] double blocked() const {
        return double(over_units([](const UnitReport& unit) { return unit.cycles.blocked; }));
    }
};

}  // namespace

RunWaits run_waits(const WorkloadReport& workload, const sim::Config& config) {
    RunWaits waits;
    if (workload.cycles == 0) return waits;
    const KindSum scheduler{workload, "scheduler"}, pair{workload, "pair"}, l1{workload, "l1"},
        link{workload, "link"};
    const auto cycles = double(workload.cycles);
    const double percent_of_units = 100 / (cycles * double(config.rtu.count));
    waits.slots = double(config.rtu.ray_slots) * double(config.rtu.count);
    waits.slots_taken = scheduler.of("slot_cycles") / cycles;
    waits.banks_percent = l1.of("bank_conflict_cycles") * percent_of_units;
    waits.mshrs_percent = (l1.of("mshr_full_cycles") + l1.of("target_full_cycles")) * percent_of_units;
    waits.pair_blocked_percent = pair.blocked() * percent_of_units;
    if (pair.of("survivors") > 0) waits.hit_wait_cycles = pair.of("hit_wait_cycles") / pair.of("survivors");
    waits.link_percent = 100 * (link.of("read_back_cycles") + link.of("upload_cycles")) / cycles;
    if (l1.of("line_reads") > 0) waits.l1_miss_percent = 100 * (1 - l1.of("hits") / l1.of("line_reads"));
    waits.spilled_entries = std::uint64_t(scheduler.of("spilled_entries"));
    return waits;
}

}  // namespace rtu::study
