#include "study/area/area_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "model/memory_image.hpp"

namespace rtu::study {
namespace {

// Cells of nand2.lib.
constexpr double mux2 = 2.33, xnor2 = 2, and2 = 1.33, flip_flop_enabled = 5.80,
                 flip_flop_reset_enabled = 6.80;
// Logic of a queue, fitted to stream_fifo: a bit of a pointer; a bit of the output for each entry but one,
// and once.
constexpr double pointer_step = 6, entry_select = 1.80, output_select = 0.53;
// The same of multi_fifo: a bit for each that is read a cycle, for each input but one, and what is seen in
// the cycle before it is there.
constexpr double multi_read = 2.00, multi_write = 2.70, multi_bypass = 1.60;
constexpr std::uint32_t stack_entry_bits = 64;
constexpr double counted_hit_units = 8;      // of the pair testers of gates.csv
constexpr std::uint32_t counted_stack = 16;  // entries of the stacks of gates.csv

std::uint32_t ceil_log2(std::uint64_t count) {
    return count <= 1 ? 0 : std::uint32_t(std::bit_width(count - 1));
}

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

// A part that is as it was synthesised.
AreaPart counted(std::string unit, std::string name, double copies, const std::string& row) {
    return {std::move(unit), std::move(name), copies, gate_counts(row), 0, true, row};
}

AreaPart formula(std::string unit, std::string name, double copies, const GateCounts& each, std::string how) {
    return {std::move(unit), std::move(name), copies, each, 0, false, std::move(how)};
}

// A counted unit of another size, to which it is taken to be proportional.
AreaPart scaled(std::string unit, std::string name, double copies, const std::string& row, double share) {
    if (share == 1) return counted(std::move(unit), std::move(name), copies, row);
    GateCounts each = times(share, gate_counts(row));
    return formula(std::move(unit), std::move(name), copies, each, fmt::format("{:.3f} {}", share, row));
}

AreaPart array(std::string unit, std::string name, double copies, double bits_each, std::string how) {
    return {std::move(unit), std::move(name), copies, {}, bits_each, false, std::move(how)};
}

// Bits of what the cache of the RTL holds beside its data.
struct CacheBits {
    double line, mshr, reply;
};

CacheBits cache_bits(const sim::Config& config) {
    const sim::Config::Cache& cache = config.l1;
    const std::uint32_t sectors = cache.line_bytes / cache.sector_bytes,
                        slot_bits = ceil_log2(config.rtu.ray_slots);
    const std::uint32_t line_number = address_bits - ceil_log2(cache.line_bytes), way = ceil_log2(cache.ways);
    const std::uint32_t target = slot_bits + sectors, targets = ceil_log2(cache.targets_per_mshr) + 1;
    const auto node_bytes = double(model::MemoryImage::node_bytes(config.bvh.width, config.bvh.node_format));
    return {double(line_number + 3 * sectors + ceil_log2(cache.mshrs) + way),
            double(line_number + way + targets + cache.targets_per_mshr * target + ceil_log2(cache.mshrs)),
            8 * node_bytes + 7 + 3 * slot_bits};
}

void add_l1(const sim::Config& config, std::vector<AreaPart>& parts) {
    const sim::Config::Cache& cache = config.l1;
    const CacheBits bits = cache_bits(config);
    const std::uint32_t lines = cache.size_bytes / cache.line_bytes;
    parts.push_back(array("l1", "data", 1, 8.0 * cache.size_bytes, "8 size_bytes"));
    parts.push_back(array("l1", "tags, states, ages", lines, bits.line, "bits of a line"));
    parts.push_back(array("l1", "MSHRs", cache.mshrs, bits.mshr, "bits of an MSHR and its targets"));
    parts.push_back(array("l1", "replies", config.rtu.ray_slots, bits.reply, "a node a slot"));
    parts.push_back(array("l1", "requests, fills, write-backs", 1, 4 * 256 + 20 * 8.0 * cache.line_bytes,
                          "4 sectors, 20 lines"));
    const GateCounts& few = gate_counts("cache_control:Ways=4");
    const GateCounts& many = gate_counts("cache_control:Ways=16");
    const GateCounts way = times(1.0 / 12, minus(many, few));
    const double banks = cache.banks / 4.0;
    GateCounts control = times(banks, minus(few, times(4, way)) + times(cache.ways, way));
    control.depth = few.depth + (double(cache.ways) - 4) / 12 * (many.depth - few.depth);
    parts.push_back(formula("l1", "control", 1, control, "cache_control, linear in ways and banks"));
    parts.push_back(scaled("l1", "data paths", 1, "cache_data", banks));
}

// Bits of the memories of a slot in rtl_ref/rtu: what box unit, pair unit and scheduler each keep of a ray.
constexpr double box_ray_bits = 355, pair_ray_bits = 322, scheduler_ray_bits = 65;
constexpr double best_hit_bits = 128 + 32 + 64;  // and what of it box and pair unit read beside it
constexpr std::uint32_t hit_bits = 161, block_bits = 12, spill_bits = 3;

// The stack's ring: what a visit leaves above the entries that stay is still in it.
std::uint32_t row_of(const sim::Config& config) { return config.rtu.stack_entries + config.bvh.width - 1; }

std::uint32_t payload_bits(const sim::Config& config) {
    return stack_entry_bits * std::max(4U, config.bvh.width);
}

// Of a stack of 8 and one of 16 entries, both 4 wide.
GateCounts survivors_area(std::uint32_t row) {
    const GateCounts& few = gate_counts("stack_survivors:Row=11");
    const GateCounts& many = gate_counts("stack_survivors:Row=19");
    const double place = (many.gates - few.gates) / 8;
    return {.gates = std::max(0.0, few.gates + place * (double(row) - 11)), .depth = many.depth};
}

// What decides for one result a cycle, and the registers between its stages.
void add_lanes(const sim::Config& config, std::vector<AreaPart>& parts) {
    const sim::Config::Rtu& rtu = config.rtu;
    const std::uint32_t row = row_of(config), counted_row = counted_stack + config.bvh.width - 1;
    const std::uint32_t slot_bits = ceil_log2(rtu.ray_slots);
    const double share = double(row) / counted_row;
    const std::string step = fmt::format("ray_step:Width={}:Row={}", config.bvh.width, counted_row);
    parts.push_back(scaled("scheduler", "ray step", rtu.results_per_cycle, step, share));
    parts.push_back(formula("scheduler", "stack survivors", rtu.results_per_cycle, survivors_area(row),
                            "stack_survivors, linear in its row"));
    const double common = payload_bits(config) + 4 + 1 + 1 + slot_bits;
    const double second = common,
                 third = common + 34 * row + 3 * ceil_log2(row + 1) + block_bits + 2 + 128 + 32;
    GateCounts stages = registers(second + third + hit_bits);
    stages += logic((2 * common + 128) * mux2);
    parts.push_back(formula("scheduler", "stages", rtu.results_per_cycle, stages,
                            "registers between stages, and their MUX2"));
}

constexpr std::uint32_t pair_number_bits = 28;  // of a NodeRef
constexpr std::uint32_t ray_number_bits = 32;   // in a word of a mailbox in memory

GateCounts comparator_area(double bits) { return logic(bits * (xnor2 + and2)); }

// Of two results a cycle: counted for powers of two, and between them linear.
GateCounts recent_mailbox_area(std::uint32_t entries) {
    const auto row = [](std::uint32_t n) { return gate_counts(fmt::format("mailbox:Entries={}", n)); };
    const std::uint32_t few = std::bit_floor(entries), many = std::bit_ceil(entries);
    if (few == many) return row(entries);
    return row(few) + times(double(entries - few) / (many - few), minus(row(many), row(few)));
}

// What a scheduler with rays that pass leaves over has more; two results a cycle were counted.
void add_passing(const sim::Config& config, std::vector<AreaPart>& parts) {
    const sim::Config::Rtu& rtu = config.rtu;
    const double lanes = rtu.results_per_cycle / 2.0;
    if (rtu.mailbox.kind == model::MailboxKind::Recent) {
        const std::string row = fmt::format("mailbox:Entries={}", rtu.mailbox.entries);
        if (lanes == 1 && std::has_single_bit(rtu.mailbox.entries)) {
            parts.push_back(counted("scheduler", "mailbox comparison", 1, row));
        } else {
            parts.push_back(formula("scheduler", "mailbox comparison", lanes,
                                    recent_mailbox_area(rtu.mailbox.entries),
                                    "mailbox, linear between powers of two"));
        }
    }
    parts.push_back(scaled("scheduler", "stacks held back", rtu.results_per_cycle,
                           "held_stack:Width=4:Row=19", row_of(config) / 19.0));
    parts.push_back(scaled("scheduler", "rays that pass leaves over", 1,
                           "multi_fifo:Width=7:Depth=8:Push=2:Pop=2",
                           std::max(1U, ceil_log2(rtu.ray_slots)) / 7.0));
}

// Of each result: the row of its ray is read, compared, and written back in one place.
void add_mailbox(const sim::Config& config, std::vector<AreaPart>& parts) {
    const sim::Config::Rtu& rtu = config.rtu;
    const model::MailboxOptions& mailbox = rtu.mailbox;
    if (!mailbox.is_on()) return;
    const double entries = mailbox.entries;
    double slot_bits = ray_number_bits;
    GateCounts compare = comparator_area(ray_number_bits);
    if (mailbox.kind == model::MailboxKind::Recent) {
        slot_bits = entries * pair_number_bits + ceil_log2(mailbox.entries) + 1;
    } else if (mailbox.kind == model::MailboxKind::Hashed) {
        slot_bits = entries * (pair_number_bits + 1);
        compare = comparator_area(pair_number_bits + 1);
        compare += logic((entries - 1) * (pair_number_bits + 1) * mux2);
    }
    parts.push_back(array("scheduler", "mailboxes", rtu.ray_slots, slot_bits, "docs/area.md"));
    if (mailbox.kind != model::MailboxKind::Recent) {
        parts.push_back(formula("scheduler", "mailbox comparison", rtu.results_per_cycle, compare,
                                "XNOR2 and AND2 a bit"));
    }
    if (mailbox.kind != model::MailboxKind::PerPair) add_passing(config, parts);
}

void add_scheduler(const sim::Config& config, std::vector<AreaPart>& parts) {
    const sim::Config::Rtu& rtu = config.rtu;
    const std::uint32_t slot_bits = ceil_log2(rtu.ray_slots);
    const double state_bits = 2 * ceil_log2(row_of(config) + 1) + block_bits;
    const double ray_bits = box_ray_bits + pair_ray_bits + scheduler_ray_bits + best_hit_bits + state_bits;
    parts.push_back(array("scheduler", "ray slots", rtu.ray_slots, ray_bits, "docs/area.md"));
    parts.push_back(array("scheduler", "stacks", rtu.ray_slots, stack_entry_bits * double(row_of(config)),
                          "64 (stack_entries + width - 1)"));
    add_lanes(config, parts);
    add_mailbox(config, parts);
    const bool passes = rtu.mailbox.is_on() && rtu.mailbox.kind != model::MailboxKind::PerPair;
    parts.push_back(
        counted("scheduler", "choice of results", 1, passes ? "result_select:Passes=1" : "result_select"));
    parts.push_back(counted("scheduler", "issue of requests", 1, "order_issue"));
    parts.push_back(
        formula("scheduler", "free slots", 1, free_slots_area(rtu.ray_slots), "slots x log2 slots bits"));
    const std::uint32_t head_bits = ceil_log2(row_of(config)) + spill_bits + 1 + slot_bits;
    const QueueShape heads{rtu.ray_slots, head_bits, rtu.results_per_cycle + 1, 2};
    parts.push_back(formula("scheduler", "order of requests", 1, multi_queue_area(heads, true),
                            fmt::format("queue of {} x {} bits", heads.depth, heads.width_bits)));
    parts.push_back(
        array("scheduler", "requests", rtu.ray_slots, block_bits + 33, "a reference, a block a slot"));
    parts.push_back(counted("scheduler", "request memory", 1, "order_ram:Width=45:Slots=128"));
    parts.push_back(
        scaled("scheduler", "stack memory", 1, "stack_ram:Slots=128:Row=19", row_of(config) / 19.0));
}

void add_queues(const sim::Config& config, std::vector<AreaPart>& parts) {
    const sim::Config::Rtu& rtu = config.rtu;
    const std::uint32_t slot_bits = ceil_log2(rtu.ray_slots), results = rtu.results_per_cycle;
    const auto add = [&](std::string name, const QueueShape& shape) {
        parts.push_back(formula("queues", std::move(name), 1, multi_queue_area(shape, false),
                                fmt::format("queue of {} x {} bits", shape.depth, shape.width_bits)));
    };
    add("box results", {2 * std::max(rtu.box.boxes_per_cycle, results),
                        stack_entry_bits * config.bvh.width + 4 + slot_bits, 1, results});
    add("pair results", {2 * std::max(rtu.pair.testers, results), 128 + 1 + slot_bits, 1, results});
    add("hits", {16, hit_bits, results + 1, results});
    add("rays", {2, 647, 1, 1});
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

AreaPart dequantiser_area(std::uint32_t lanes) {
    // Shifting 8 bits until the first is a one, in 3 steps. The step is a power of two: no multiplier.
    constexpr double normalise = 24 * mux2, planes = 6;
    return formula("box", "dequantisers", planes * lanes, gate_counts("fp32_add") + logic(normalise),
                   "fp32_add + 24 MUX2, a plane");
}

std::vector<AreaPart> pair_area(const sim::Config::Rtu::Pair& pair) {
    const auto mode = std::uint32_t(pair.mode);
    const std::string first_pass = fmt::format("pair_reject:Mode={}", mode);
    std::vector<AreaPart> parts{counted("pair", "first pass", pair.testers, first_pass)};
    if (pair.hit_units == 0) return parts;
    const GateCounts whole = gate_counts(fmt::format("pair_tester:Mode={}", mode));
    const GateCounts control =
        minus(minus(whole, gate_counts(first_pass)), times(counted_hit_units, gate_counts("hit_unit")));
    parts.push_back(counted("pair", "hit units", double(pair.testers) * pair.hit_units, "hit_unit"));
    parts.push_back(formula("pair", "queues and choice", pair.testers,
                            times(pair.hit_units / counted_hit_units, control),
                            "pair_tester - first pass - 8 hit_unit, a hit unit"));
    parts.push_back(array("pair", "pairs under way", pair.testers, 745.0 * pair.entries, "745 entries"));
    return parts;
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

GateCounts multi_queue_area(const QueueShape& shape, bool shows_next) {
    const double bits = double(shape.depth) * shape.width_bits;
    const double pointer_bits = 2.0 * std::max(1U, ceil_log2(shape.depth)) + ceil_log2(shape.depth + 1);
    GateCounts area = registers(bits);
    area.register_bits += pointer_bits;
    area.register_gates += pointer_bits * flip_flop_reset_enabled;
    area.gates += pointer_bits * (flip_flop_reset_enabled + pointer_step);
    area.gates += bits * (multi_read * shape.pop * (shows_next ? 2 : 1) + multi_write * (shape.push - 1));
    if (shows_next) area.gates += multi_bypass * shape.push * shape.pop * shape.width_bits;
    return area;
}

GateCounts free_slots_area(std::uint32_t slots) {
    constexpr double bit_logic = 4.9, once = 190;  // fitted to free_slots of 16 and 128
    const double bits = double(slots) * ceil_log2(slots);
    GateCounts area = registers(bits);
    area.gates += bit_logic * bits + once;
    return area;
}

std::vector<AreaPart> rtu_area(const sim::Config& config) {
    std::vector<AreaPart> parts = box_area(config.rtu.box.boxes_per_cycle, config.bvh.width);
    if (config.bvh.node_format == model::NodeFormat::Quantised) {
        parts.push_back(dequantiser_area(config.rtu.box.boxes_per_cycle));
    }
    for (AreaPart& part : pair_area(config.rtu.pair)) parts.push_back(std::move(part));
    add_scheduler(config, parts);
    add_queues(config, parts);
    add_l1(config, parts);
    return parts;
}

double ps_per_gate(double depth, std::uint32_t clock_mhz) { return depth > 0 ? 1e6 / clock_mhz / depth : 0; }

}  // namespace rtu::study
