#include "study/validate/validate_configs.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "model/error.hpp"
#include "sim/config_keys.hpp"
#include "sim/effective_config.hpp"
#include "study/validate/rtl_reference.hpp"

namespace rtu::study {
namespace {

struct Difference {
    const char* name;
    std::vector<std::string> sets;
};

const std::vector<Difference>& differences() {
    static const std::vector<Difference> all{
        {"base", {}},
        {"slots_1", {"rtu.ray_slots=1"}},
        {"slots_4", {"rtu.ray_slots=4"}},
        {"slots_16", {"rtu.ray_slots=16"}},
        {"slots_128", {"rtu.ray_slots=128"}},
        {"width_2", {"bvh.width=2", "rtu.box.boxes_per_cycle=2"}},
        {"width_8", {"bvh.width=8", "rtu.box.boxes_per_cycle=8"}},
        {"single", {"rtu.pair.mode=single"}},
        {"dual_independent", {"rtu.pair.mode=dual_independent"}},
        {"memory_20", {"memory.latency_cycles=20"}},
        {"memory_400", {"memory.latency_cycles=400"}},
        {"bandwidth_4", {"memory.bytes_per_cycle=4"}},
        {"bandwidth_128", {"memory.bytes_per_cycle=128"}},
        {"tiny_cache", {"l1.size_bytes=2048", "l1.ways=4", "l1.mshrs=16"}},
        {"stack_2", {"rtu.stack_entries=2"}},
        {"stack_4_tiny_cache", {"rtu.stack_entries=4", "l1.size_bytes=2048", "l1.ways=4", "l1.mshrs=16"}},
        {"splits", {"bvh.splits=spatial"}},
        {"mailbox_4", {"bvh.splits=spatial", "rtu.mailbox.entries=4"}},
        {"mailbox_16", {"bvh.splits=spatial", "rtu.mailbox.entries=16"}},
    };
    return all;
}

// What the RTL takes when it runs, or has several builds for.
constexpr auto free_keys = std::to_array<std::string_view>(
    {"bvh.width", "bvh.splits", "bvh.split_budget_percent", "rtu.box.boxes_per_cycle", "rtu.ray_slots",
     "rtu.stack_entries", "rtu.mailbox.entries", "rtu.pair.mode", "rtu.pair.hit_units", "l1.size_bytes",
     "l1.ways", "l1.banks", "l1.mshrs", "l1.targets_per_mshr", "l1.latency_cycles", "memory.latency_cycles",
     "memory.bytes_per_cycle", "clock_mhz", "watchdog_cycles"});

// What a machine with a flat memory does not have.
bool is_unused(std::string_view key) { return key.starts_with("l2.") || key.starts_with("dram."); }

std::string_view key_of(std::string_view set) { return set.substr(0, set.find('=')); }

// `sets`, and of `others` those of other keys.
std::vector<std::string> with_defaults(std::vector<std::string> sets,
                                       const std::vector<std::string>& others) {
    const std::size_t given = sets.size();
    for (const std::string& other : others) {
        const auto is_it = [&](const std::string& set) { return key_of(set) == key_of(other); };
        if (std::none_of(sets.begin(), sets.begin() + std::ptrdiff_t(given), is_it)) sets.push_back(other);
    }
    return sets;
}

}  // namespace

std::vector<std::string> validated_machine() {
    return {"memory.model=flat", "rtu.ray_slots=64", "rtu.scheduler.latency_cycles=3"};
}

std::vector<ValidateConfig> validate_configs() {
    std::vector<ValidateConfig> configs;
    for (const Difference& difference : differences()) {
        const std::vector<std::string> sets = with_defaults(difference.sets, validated_machine());
        configs.push_back(
            {difference.name, difference.sets, sim::load_config("default", std::nullopt, sets).config});
    }
    return configs;
}

sim::Config simulated_instead(const ValidateConfig& config, const std::vector<std::string>& sim_sets) {
    for (const std::string& set : sim_sets) {
        if (!set.starts_with("bvh.")) continue;
        throw Error("{}: expected a key of the machine: simulator and RTL walk the same tree", set);
    }
    const std::vector<std::string> sets = with_defaults(config.sets, validated_machine());
    return sim::load_config("default", std::nullopt, with_defaults(sim_sets, sets)).config;
}

void check_is_rtl_machine(const sim::Config& config) {
    const sim::Config rtl = sim::load_config("default", std::nullopt, validated_machine()).config;
    for (const sim::ConfigKey& key : sim::config_keys()) {
        if (is_unused(key.name) || std::ranges::find(free_keys, key.name) != free_keys.end()) continue;
        const std::string expected = config_value_text(rtl, key), got = config_value_text(config, key);
        if (expected != got) throw Error("{}: the RTL reference has {}, got {}", key.name, expected, got);
    }
    if (config.rtu.box.boxes_per_cycle != config.bvh.width) {
        throw Error("rtu.box.boxes_per_cycle: the RTL reference has a lane for each of {} children, got {}",
                    config.bvh.width, config.rtu.box.boxes_per_cycle);
    }
}

}  // namespace rtu::study
