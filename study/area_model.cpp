#include "study/area_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace rtu::study {
namespace {

// Cells of nand2.lib.
constexpr double and2 = 1.33, xnor2 = 2.00, mux2 = 2.33, flip_flop_enabled = 5.80,
                 flip_flop_reset_enabled = 6.80;
// Logic of a queue, fitted to stream_fifo: a bit of a pointer; a bit of the output for each entry but one,
// and once.
constexpr double pointer_step = 6, entry_select = 1.80, output_select = 0.53;
constexpr std::uint32_t stack_entry_bits = 64;

std::uint32_t ceil_log2(std::uint64_t count) {
    return count <= 1 ? 0 : std::uint32_t(std::bit_width(count - 1));
}

// Of a request on its way to the L1: address, size in bytes, slot, who gets the reply, whether it writes.
std::uint32_t request_bits(std::uint32_t slot_bits) { return address_bits + 9 + slot_bits + 2 + 1; }

const GateCounts& order_of(std::uint32_t width) {
    return gate_counts(fmt::format("near_to_far:Width={}", width));
}

GateCounts lanes_of(std::uint32_t width) {
    return minus(gate_counts(fmt::format("box_tester:Width={}", width)), order_of(width));
}

GateCounts registers(double bits) {
    return {
        .gates = bits * flip_flop_enabled, .register_bits = bits, .register_gates = bits * flip_flop_enabled};
}

GateCounts logic(double gates) { return {.gates = gates}; }

// a < b: a comparator without its registers and the two multiplexers behind it.
GateCounts comparison() {
    const GateCounts& unit = gate_counts("fp32_compare");
    return {.gates = unit.gates - unit.register_gates - 64 * mux2, .depth = unit.depth};
}

// A part that is as it was synthesised.
AreaPart counted(std::string unit, std::string name, double copies, const std::string& row) {
    return {std::move(unit), std::move(name), copies, gate_counts(row), 0, true, row};
}

AreaPart formula(std::string unit, std::string name, double copies, const GateCounts& each, std::string how) {
    return {std::move(unit), std::move(name), copies, each, 0, false, std::move(how)};
}

AreaPart array(std::string unit, std::string name, double copies, double bits_each, std::string how) {
    return {std::move(unit), std::move(name), copies, {}, bits_each, false, std::move(how)};
}

// What follows is one line of a cache; sizes in bits.
struct CacheGeometry {
    std::uint32_t lines, sectors, tag_bits, lru_bits;
};

CacheGeometry geometry(const sim::Config::Cache& cache) {
    const std::uint32_t lines = cache.size_bytes / cache.line_bytes;
    const std::uint32_t sectors = cache.line_bytes / cache.sector_bytes;
    const std::uint32_t tag_bits = address_bits - ceil_log2(cache.line_bytes) - ceil_log2(lines / cache.ways);
    return {lines, sectors, tag_bits, ceil_log2(cache.ways)};
}

void add_l1(const sim::Config& config, std::vector<AreaPart>& parts) {
    const sim::Config::Cache& cache = config.l1;
    const auto [lines, sectors, tag_bits, lru_bits] = geometry(cache);
    const std::uint32_t slot_bits = ceil_log2(config.rtu.ray_slots);
    parts.push_back(array("l1", "data", 1, 8.0 * cache.size_bytes, "8 size_bytes"));
    parts.push_back(
        array("l1", "tags", lines, tag_bits + 2 * sectors + lru_bits, "line: tag + 2 sectors + log2 ways"));
    parts.push_back(array("l1", "MSHRs", cache.mshrs,
                          ceil_log2(lines) + sectors + cache.targets_per_mshr * (slot_bits + sectors),
                          "log2 lines + sectors + targets (log2 slots + sectors)"));
    parts.push_back(formula("l1", "tag comparison", double(cache.banks) * cache.ways,
                            logic(tag_bits * (xnor2 + and2)), "tag bits of XNOR2 and AND2"));
    parts.push_back(formula("l1", "reply pipeline", cache.banks,
                            registers(double(cache.latency_cycles) * (slot_bits + 2)),
                            "latency (log2 slots + 2) register bits"));
    parts.push_back(formula("l1", "reply routing", 3,
                            logic((cache.banks - 1) * 8.0 * cache.line_bytes * mux2),
                            "8 line_bytes (banks - 1) MUX2"));
}

void add_scheduler(const sim::Config& config, std::vector<AreaPart>& parts) {
    const sim::Config::Rtu& rtu = config.rtu;
    const double row_bits = double(stack_entry_bits) * rtu.stack_entries;
    const std::uint32_t slot_bits = ceil_log2(rtu.ray_slots);
    parts.push_back(array("scheduler", "ray slots", rtu.ray_slots, ray_slot_bits, "docs/area.md"));
    parts.push_back(array("scheduler", "stacks", rtu.ray_slots, row_bits, "64 stack_entries"));
    parts.push_back(array("scheduler", "free slots", rtu.ray_slots, slot_bits, "log2 slots"));
    parts.push_back(array("scheduler", "fetch queue", rtu.ray_slots, request_bits(slot_bits),
                          "address, size, slot, who, write"));
    GateCounts pop = times(rtu.stack_entries, comparison());
    pop += logic((rtu.stack_entries - 1) * double(stack_entry_bits) * mux2);
    parts.push_back(formula("scheduler", "stack pop", rtu.results_per_cycle, pop,
                            "stack_entries comparisons, 64 (stack_entries - 1) MUX2"));
    parts.push_back(formula("scheduler", "stack push", rtu.results_per_cycle,
                            logic(row_bits * config.bvh.width * mux2), "64 stack_entries width MUX2"));
}

void add_queues(const sim::Config& config, std::vector<AreaPart>& parts) {
    const sim::Config::Rtu& rtu = config.rtu;
    const std::uint32_t slot_bits = ceil_log2(rtu.ray_slots);
    const auto add = [&](std::string name, std::uint32_t depth, std::uint32_t bits) {
        parts.push_back(formula("queues", std::move(name), 1, queue_area(depth, bits),
                                fmt::format("queue of {} x {} bits", depth, bits)));
    };
    // Data of nodes and leaves lies in arrays: only a few of many bits are read in a cycle.
    const auto add_wide = [&](const std::string& name, std::uint32_t depth, std::uint32_t bits) {
        add(name, depth, slot_bits);
        parts.push_back(array("queues", name + " data", depth, bits, "bits of an entry"));
    };
    add("requests", 2 * rtu.fetches_per_cycle, request_bits(slot_bits));
    add_wide("nodes", 2 * config.l1.banks, 228 * config.bvh.width);
    add_wide("leaves", 2 * config.l1.banks, 512);
    add_wide("stack blocks", 2 * config.l1.banks, 256);
    add("box results", 2 * std::max(rtu.box.boxes_per_cycle, rtu.results_per_cycle), slot_bits);
    add("pair results", 2 * std::max(rtu.pair.testers, rtu.results_per_cycle), slot_bits);
    add("rays", 2, 512);
    add("hits", 2 * (rtu.results_per_cycle + 1), 32 + 129);
}

}  // namespace

AreaTotal total(std::span<const AreaPart> parts) {
    AreaTotal sum;
    for (const AreaPart& part : parts) {
        sum.gates += part.gates();
        sum.sram_bits += part.sram_bits();
    }
    return sum;
}

GateCounts box_lane_area() { return times(1.0 / 6, minus(lanes_of(8), lanes_of(2))); }

GateCounts box_common_area() { return minus(lanes_of(2), times(2, box_lane_area())); }

std::vector<AreaPart> box_area(std::uint32_t lanes, std::uint32_t width) {
    if (lanes % width == 0) {
        const std::uint32_t testers = lanes / width;
        return {counted("box", "box tester", testers, fmt::format("box_tester:Width={}", width))};
    }
    const std::uint32_t nodes = std::max(1U, lanes / width);
    std::vector<AreaPart> parts{
        formula("box", "lanes", lanes, box_lane_area(), "(box_tester 8 - 2, without near_to_far) / 6"),
        formula("box", "what lanes share", nodes, box_common_area(),
                "box_tester:Width=2 - near_to_far - 2 lanes"),
        counted("box", "ordering", nodes, fmt::format("near_to_far:Width={}", width))};
    if (lanes >= width) return parts;
    const std::uint32_t steps = (width + lanes - 1) / lanes;
    parts.push_back(formula("box", "results of a node", 1, registers(64.0 * (width - lanes)),
                            "64 (width - lanes) register bits"));
    parts.push_back(formula("box", "lane inputs", lanes, logic(192.0 * (steps - 1) * mux2),
                            "192 (ceil(width / lanes) - 1) MUX2"));
    return parts;
}

std::vector<AreaPart> pair_area(const sim::Config::Rtu::Pair& pair) {
    return {counted("pair", "first pass", pair.testers,
                    fmt::format("pair_reject:Mode={}", std::uint32_t(pair.mode))),
            counted("pair", "exact sides", pair.testers, "exact_side")};
}

GateCounts queue_area(std::uint32_t depth, std::uint32_t width_bits) {
    const double pointer_bits = 2.0 * std::max(1U, ceil_log2(depth)) + ceil_log2(depth + 1);
    GateCounts area = registers(double(depth) * width_bits);
    area.register_bits += pointer_bits;
    area.register_gates += pointer_bits * flip_flop_reset_enabled;
    area.gates += pointer_bits * (flip_flop_reset_enabled + pointer_step);
    area.gates += width_bits * (entry_select * (depth - 1) + output_select);
    return area;
}

std::vector<AreaPart> rtu_area(const sim::Config& config) {
    std::vector<AreaPart> parts = box_area(config.rtu.box.boxes_per_cycle, config.bvh.width);
    for (AreaPart& part : pair_area(config.rtu.pair)) parts.push_back(std::move(part));
    add_scheduler(config, parts);
    add_queues(config, parts);
    add_l1(config, parts);
    return parts;
}

double ps_per_gate(double depth, std::uint32_t clock_mhz) { return depth > 0 ? 1e6 / clock_mhz / depth : 0; }

}  // namespace rtu::study
