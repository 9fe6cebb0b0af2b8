#include "sim/config_keys.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <vector>

#include "model/error.hpp"
#include "model/one_line.hpp"

namespace rtu::sim {
namespace {

using Form = ConfigKey::Form;
using Field = ConfigKey::Field;

const ConfigKey rows[] = {
    {"clock_mhz", "MHz", "the one clock of the machine; turns cycles into MRPS", 1, 10'000U, Form::Any,
     "[arches] TRaX preset; leaves 23.8 ps for each of the 42 gates of the deepest stage of [rtl]",
     [](Config& c) -> Field { return &c.clock_mhz; }},
    {"watchdog_cycles", "cycles", "without any progress after which a run fails", 100'000U, 4'000'000'000U,
     Form::Any, "chosen: far beyond the sum of all latencies",
     [](Config& c) -> Field { return &c.watchdog_cycles; }},
    {"host.rays_per_cycle", "rays/cycle", "rays that the host offers to the machine", 1, 64, Form::Any,
     "[arches] an RT core accepts 1 ray a clock", [](Config& c) -> Field { return &c.host.rays_per_cycle; }},
    {"link.count", "links", "links between host and machine; 0: rays and hits move for free", 0, 1, Form::Any,
     "chosen: the machine alone is what is studied", [](Config& c) -> Field { return &c.link.count; }},
    {"link.up_mb_per_second", "MB/s", "bandwidth from the host to the machine", 1, 1'000'000U, Form::Any,
     "[pcie] 4.0 x16, 256 of 280 bytes", [](Config& c) -> Field { return &c.link.up_mb_per_second; }},
    {"link.down_mb_per_second", "MB/s", "bandwidth from the machine to the host", 1, 1'000'000U, Form::Any,
     "[pcie] 4.0 x16, 256 of 280 bytes", [](Config& c) -> Field { return &c.link.down_mb_per_second; }},
    {"link.wires", "directions", "directions that move at once; 1: they take turns", 1, 2, Form::Any,
     "[pcie] a lane is a pair of wires each way", [](Config& c) -> Field { return &c.link.wires; }},
    {"link.latency_ns", "ns", "last byte sent to transfer complete", 0, 1'000'000U, Form::Any,
     "[pcie-rtt] half of the 850 ns of a round trip", [](Config& c) -> Field { return &c.link.latency_ns; }},
    {"link.overhead_ns", "ns", "host time that each transfer takes before its first byte", 0, 1'000'000'000U,
     Form::Any, "[dualpath] 5 to 7 us a call of cudaMemcpyAsync",
     [](Config& c) -> Field { return &c.link.overhead_ns; }},
    {"link.outstanding", "transfers", "transfers under way, up and down together", 1, 1024, Form::Any,
     "assumed: more than the batches under way", [](Config& c) -> Field { return &c.link.outstanding; }},
    {"link.buffers", "batches", "batches under way, each with its place in the machine; 2: double buffering",
     1, 64, Form::Any, "assumed: one moves while another is worked on",
     [](Config& c) -> Field { return &c.link.buffers; }},
    {"link.buffer_bytes", "bytes", "operands of a batch that lie close to the testers; for `rtusim stream`",
     0, 1'073'741'824U, Form::Any, "assumed: as l1.size_bytes",
     [](Config& c) -> Field { return &c.link.buffer_bytes; }},
    {"link.batch_rays", "rays", "rays that go up in one transfer; not for `rtusim stream`", 1, 16'777'216U,
     Form::Any, "assumed: as large as a small picture",
     [](Config& c) -> Field { return &c.link.batch_rays; }},
    {"bvh.width", "children", "children of an inner node", 2, 8, Form::Even,
     "[rayflex] and [prism] test 4 boxes a node", [](Config& c) -> Field { return &c.bvh.width; }},
    {"bvh.max_leaf_pairs", "pairs", "triangle pairs in a leaf", 1, 8, Form::Any,
     "[gen-rt] a quad leaf holds 1 pair", [](Config& c) -> Field { return &c.bvh.max_leaf_pairs; }},
    {"bvh.node_format", "", "boxes of inner nodes: binary32, or 8-bit steps on a grid of the node", 0, 0,
     Form::Any, "[rtl] reads binary32; products compress, as [YKL17] and [gen-rt]",
     [](Config& c) -> Field { return &c.bvh.node_format; }},
    {"bvh.builder", "", "how the builder chooses a node's children: least surface, or along a curve", 0, 0,
     Form::Any, "[Embree] its default, medium quality; morton is its low one",
     [](Config& c) -> Field { return &c.bvh.builder; }},
    {"bvh.splits", "", "how the builder divides a node's pairs: whole, or also cut by a plane", 0, 0,
     Form::Any, "chosen: every pair in one leaf", [](Config& c) -> Field { return &c.bvh.splits; }},
    {"bvh.split_budget_percent", "%", "leaves that spatial splits may add, of the pairs", 1, 1000, Form::Any,
     "[Embree] replicates at most 1.2 times", [](Config& c) -> Field { return &c.bvh.split_budget_percent; }},
    {"rtu.count", "RTUs", "ray-tracing units that share L2 and DRAM", 1, 64, Form::Any,
     "chosen: one unit is what is studied", [](Config& c) -> Field { return &c.rtu.count; }},
    {"rtu.ray_slots", "rays", "rays in flight in an RTU", 1, 4096, Form::Any,
     "[vulkan-sim] 4 warps of 32 rays in an RT unit; [arches] 64 or 128",
     [](Config& c) -> Field { return &c.rtu.ray_slots; }},
    {"rtu.stack_entries", "entries", "traversal stack of a ray on chip; deeper entries spill to memory", 1,
     256, Form::Any, "[prism] short stack of 16; [radv] 16 entries on chip",
     [](Config& c) -> Field { return &c.rtu.stack_entries; }},
    {"rtu.results_per_cycle", "results/cycle", "unit results that the ray scheduler takes", 1, 64, Form::Any,
     "[rtl] two lanes of the scheduler: a result of the box unit and one of the pair unit",
     [](Config& c) -> Field { return &c.rtu.results_per_cycle; }},
    {"rtu.fetches_per_cycle", "requests/cycle", "requests that the ray scheduler sends to its L1", 1, 64,
     Form::Any, "[rtl] two requests a cycle feed the box unit and the pair unit together",
     [](Config& c) -> Field { return &c.rtu.fetches_per_cycle; }},
    {"rtu.mailbox.kind", "", "where a ray keeps the pairs that it was tested with; per_pair is in memory", 0,
     0, Form::Any, "[SSK07] the last pairs, compared at once",
     [](Config& c) -> Field { return &c.rtu.mailbox.kind; }},
    {"rtu.mailbox.entries", "entries", "pairs that a ray remembers on chip; 0: none. Not of per_pair", 0,
     model::max_mailbox_entries, Form::Any, "chosen: without spatial splits there is nothing to find",
     [](Config& c) -> Field { return &c.rtu.mailbox.entries; }},
    {"rtu.scheduler.latency_cycles", "cycles", "result taken to the next request, or the hit, of its ray", 0,
     1000, Form::Any, "[rtl] stack and best hit are read, compared, written: three stages",
     [](Config& c) -> Field { return &c.rtu.scheduler.latency_cycles; }},
    {"rtu.box.boxes_per_cycle", "boxes/cycle", "child boxes that the box unit tests", 1, 64, Form::Any,
     "[rayflex] 4 ray-box tests a clock", [](Config& c) -> Field { return &c.rtu.box.boxes_per_cycle; }},
    {"rtu.box.packs_nodes", "", "1: lanes that a node with few children leaves idle take the next node", 0, 1,
     Form::Any, "[rtl] a tester takes a node", [](Config& c) -> Field { return &c.rtu.box.packs_nodes; }},
    {"rtu.box.latency_cycles", "cycles", "issue to result of a box test", 1, 1000, Form::Any,
     "[rtl] 12 stages, as many as the pipeline of [rayflex]",
     [](Config& c) -> Field { return &c.rtu.box.latency_cycles; }},
    {"rtu.box.dequantise_cycles", "cycles", "more for a node whose boxes are quantised: its planes are made",
     0, 1000, Form::Any, "assumed: 4 stages of the adder of [rtl], 1 to normalise 8 bits; no multiplier",
     [](Config& c) -> Field { return &c.rtu.box.dequantise_cycles; }},
    {"rtu.pair.mode", "", "how a pair of triangles is tested", 0, 0, Form::Any,
     "chosen: shared common-edge arithmetic is what is studied",
     [](Config& c) -> Field { return &c.rtu.pair.mode; }},
    {"rtu.pair.testers", "testers", "pair testers side by side", 1, 64, Form::Any,
     "[arches], [prism] and [rtcore-systemc]: 1 triangle tester",
     [](Config& c) -> Field { return &c.rtu.pair.testers; }},
    {"rtu.pair.ii_cycles", "cycles", "initiation interval of a pair tester", 1, 1000, Form::Any,
     "[rtl] a pair a cycle, in single a triangle; [prism] a triangle a clock",
     [](Config& c) -> Field { return &c.rtu.pair.ii_cycles; }},
    {"rtu.pair.latency_cycles", "cycles", "issue to result of a pair test; with hit units, of its first pass",
     1, 1000, Form::Any, "[rtl] 33 stages of the first pass",
     [](Config& c) -> Field { return &c.rtu.pair.latency_cycles; }},
    {"rtu.pair.replay_cycles", "cycles",
     "extra occupation of a tester without hit units, in dual_shared, when both triangles of a pair need the "
     "exact pass",
     0, 1000, Form::Any, "assumed: the one unit of that pass is used a second time; unused with hit units",
     [](Config& c) -> Field { return &c.rtu.pair.replay_cycles; }},
    {"rtu.pair.hit_units", "units",
     "of a tester, for what its first pass leaves; 0: the whole test is in the tester's pipeline", 0, 64,
     Form::Any, "[rtl] as built: 16 gain less than 1 % on the built-in scene",
     [](Config& c) -> Field { return &c.rtu.pair.hit_units; }},
    {"rtu.pair.hit_cycles", "cycles", "that a triangle which becomes the best hit holds a hit unit", 1, 1000,
     Form::Any, "[rtl] distance, u and v one after the other",
     [](Config& c) -> Field { return &c.rtu.pair.hit_cycles; }},
    {"rtu.pair.reject_cycles", "cycles", "that a triangle which does not holds it", 1, 1000, Form::Any,
     "[rtl] the distance alone", [](Config& c) -> Field { return &c.rtu.pair.reject_cycles; }},
    {"rtu.pair.side_cycles", "cycles", "more for a triangle whose sides the first pass left open", 0, 1000,
     Form::Any, "[rtl] three edges", [](Config& c) -> Field { return &c.rtu.pair.side_cycles; }},
    {"rtu.pair.entries", "leaves", "inside a tester with hit units", 1, 1024, Form::Any,
     "[rtl] enough for one pair a cycle", [](Config& c) -> Field { return &c.rtu.pair.entries; }},
    {"l1.size_bytes", "bytes", "capacity of the node and leaf cache of an RTU", 1024, 268'435'456U, Form::Any,
     "[vulkan-sim] RT cache of 64 KiB; [arches] 64 KiB", [](Config& c) -> Field { return &c.l1.size_bytes; }},
    {"l1.line_bytes", "bytes", "cache line", 32, 1024, Form::PowerOfTwo, "[vulkan-sim] 128",
     [](Config& c) -> Field { return &c.l1.line_bytes; }},
    {"l1.sector_bytes", "bytes", "part of a line that is fetched on its own", 16, 1024, Form::PowerOfTwo,
     "[vulkan-sim] 32, sectored", [](Config& c) -> Field { return &c.l1.sector_bytes; }},
    {"l1.ways", "ways", "associativity", 1, 512, Form::Any, "[vulkan-sim] 16 ways",
     [](Config& c) -> Field { return &c.l1.ways; }},
    {"l1.banks", "banks", "each serves one line a cycle", 1, 64, Form::PowerOfTwo, "[vulkan-sim] 4 banks",
     [](Config& c) -> Field { return &c.l1.banks; }},
    {"l1.mshrs", "entries", "outstanding line misses", 1, 4096, Form::Any, "[vulkan-sim] 64 in an RT unit",
     [](Config& c) -> Field { return &c.l1.mshrs; }},
    {"l1.targets_per_mshr", "requests", "requests that wait on one outstanding line", 1, 4096, Form::Any,
     "assumed: between the 8 of the data cache and the 256 of the RT cache in [vulkan-sim]",
     [](Config& c) -> Field { return &c.l1.targets_per_mshr; }},
    {"l1.latency_cycles", "cycles", "request seen to reply sent, for a hit", 1, 10'000U, Form::Any,
     "[vulkan-sim] and [arches] 20", [](Config& c) -> Field { return &c.l1.latency_cycles; }},
    {"memory.model", "", "what is below the L1s: the L2 and the DRAM, or neither but a flat memory", 0, 0,
     Form::Any, "assumed: as in every GPU", [](Config& c) -> Field { return &c.memory.model; }},
    {"memory.latency_cycles", "cycles", "of a flat memory, both ways together", 1, 10'000U, Form::Any,
     "assumed: about an L2 hit", [](Config& c) -> Field { return &c.memory.latency_cycles; }},
    {"memory.bytes_per_cycle", "bytes/cycle", "bandwidth of a flat memory", 1, 1024, Form::Any,
     "assumed: one sector a cycle", [](Config& c) -> Field { return &c.memory.bytes_per_cycle; }},
    {"l2.size_bytes", "bytes", "capacity of the cache that all RTUs share", 1024, 268'435'456U, Form::Any,
     "[arches] 8 x 512 KiB", [](Config& c) -> Field { return &c.l2.size_bytes; }},
    {"l2.line_bytes", "bytes", "cache line", 32, 1024, Form::PowerOfTwo, "[vulkan-sim] 128",
     [](Config& c) -> Field { return &c.l2.line_bytes; }},
    {"l2.sector_bytes", "bytes", "part of a line that is fetched on its own", 16, 1024, Form::PowerOfTwo,
     "[vulkan-sim] 32, sectored", [](Config& c) -> Field { return &c.l2.sector_bytes; }},
    {"l2.ways", "ways", "associativity", 1, 512, Form::Any, "[vulkan-sim] and [arches] 16 ways",
     [](Config& c) -> Field { return &c.l2.ways; }},
    {"l2.banks", "banks", "each serves one line a cycle", 1, 64, Form::PowerOfTwo,
     "[arches] 4 slices a partition", [](Config& c) -> Field { return &c.l2.banks; }},
    {"l2.mshrs", "entries", "outstanding line misses", 1, 4096, Form::Any,
     "assumed: below the 192 of a partition in [vulkan-sim] and [arches]",
     [](Config& c) -> Field { return &c.l2.mshrs; }},
    {"l2.targets_per_mshr", "requests", "requests that wait on one outstanding line", 1, 4096, Form::Any,
     "assumed: as in L1", [](Config& c) -> Field { return &c.l2.targets_per_mshr; }},
    {"l2.latency_cycles", "cycles", "request seen to reply sent, for a hit", 1, 10'000U, Form::Any,
     "[arches] 160 cycles at 1515 MHz are 106 ns, rounded",
     [](Config& c) -> Field { return &c.l2.latency_cycles; }},
    {"dram.channels", "channels", "independent channels, interleaved by address", 1, 64, Form::PowerOfTwo,
     "assumed: a mobile memory system", [](Config& c) -> Field { return &c.dram.channels; }},
    {"dram.banks", "banks", "of a channel", 1, 64, Form::PowerOfTwo, "[vulkan-sim] and [ramulator2] 16",
     [](Config& c) -> Field { return &c.dram.banks; }},
    {"dram.row_bytes", "bytes", "of a bank, open at a time", 256, 65'536U, Form::PowerOfTwo,
     "[vulkan-sim] address map: 2 KiB a row", [](Config& c) -> Field { return &c.dram.row_bytes; }},
    {"dram.queue_entries", "requests", "waiting at a channel", 1, 1024, Form::Any,
     "[ramulator2] read buffer of 32", [](Config& c) -> Field { return &c.dram.queue_entries; }},
    {"dram.bytes_per_cycle", "bytes/cycle", "bandwidth of a channel, in clocks of the machine", 1, 1024,
     Form::Any, "assumed: a 16-bit LPDDR5X-8533 channel moves 17 GB/s",
     [](Config& c) -> Field { return &c.dram.bytes_per_cycle; }},
    {"dram.t_rcd_cycles", "cycles", "row activation to column access", 0, 1000, Form::Any,
     "[ramulator2] GDDR6 nRCDRD 26 x 0.57 ns", [](Config& c) -> Field { return &c.dram.t_rcd_cycles; }},
    {"dram.t_rp_cycles", "cycles", "precharge to activation", 0, 1000, Form::Any,
     "[ramulator2] GDDR6 nRP 26 x 0.57 ns", [](Config& c) -> Field { return &c.dram.t_rp_cycles; }},
    {"dram.t_cas_cycles", "cycles", "column access to first data", 1, 1000, Form::Any,
     "[ramulator2] GDDR6 nCL 24 x 0.57 ns", [](Config& c) -> Field { return &c.dram.t_cas_cycles; }},
    {"dram.latency_cycles", "cycles", "controller and link, both ways together", 1, 10'000U, Form::Any,
     "[arches] 92 cycles at 1515 MHz are 61 ns, rounded",
     [](Config& c) -> Field { return &c.dram.latency_cycles; }},
};

constexpr std::array<std::string_view, 3> mode_names{"single", "dual_independent", "dual_shared"};
constexpr std::array<std::string_view, 2> memory_model_names{"dram", "flat"};
constexpr std::array<std::string_view, 2> node_format_names{to_string(model::NodeFormat::Full),
                                                            to_string(model::NodeFormat::Quantised)};
constexpr std::array<std::string_view, 2> builder_names{"sah", "morton"};
constexpr std::array<std::string_view, 2> split_names{"object", "spatial"};
constexpr std::array<std::string_view, 3> mailbox_names{"recent", "hashed", "per_pair"};

/// Insertions, deletions and substitutions between two words (Levenshtein's distance).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
        }
    }
    return row[b.size()];
}

/// The key that was probably meant: it ends in the word, or is a few typing errors away.
std::optional<std::string_view> nearest_key(std::string_view name) {
    constexpr std::size_t longest_worth_comparing = 64;
    if (name.empty() || name.size() > longest_worth_comparing) return std::nullopt;
    std::optional<std::string_view> nearest;
    std::size_t nearest_distance = 2 + name.size() / 4;
    for (const ConfigKey& key : config_keys()) {
        const std::string_view last_word = key.name.substr(key.name.rfind('.') + 1);
        const std::size_t distance =
            name == last_word ? 0
                              : std::min(edit_distance(name, key.name), edit_distance(name, last_word) + 1);
        if (distance < nearest_distance) {
            nearest = key.name;
            nearest_distance = distance;
        }
    }
    return nearest;
}

std::string quoted_list(std::span<const std::string_view> words) {
    std::string text(words.front());
    for (std::size_t i = 1; i < words.size(); ++i) {
        text += i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

}  // namespace

std::span<const ConfigKey> config_keys() { return rows; }

std::span<const std::string_view> pair_mode_names() { return mode_names; }

std::span<const std::string_view> choice_names(const ConfigKey::Field& field) {
    if (std::holds_alternative<PairMode*>(field)) return mode_names;
    if (std::holds_alternative<MemoryModel*>(field)) return memory_model_names;
    if (std::holds_alternative<model::NodeFormat*>(field)) return node_format_names;
    if (std::holds_alternative<BvhBuilder*>(field)) return builder_names;
    if (std::holds_alternative<SplitKind*>(field)) return split_names;
    if (std::holds_alternative<MailboxKind*>(field)) return mailbox_names;
    return {};
}

std::size_t config_key_index(std::string_view name, std::string_view place) {
    const auto row = std::ranges::find(rows, name, &ConfigKey::name);
    if (row != std::end(rows)) return std::size_t(row - std::begin(rows));
    const std::optional<std::string_view> nearest = nearest_key(name);
    throw Error("{}: expected a configuration key, got '{}'{}", place, model::one_line(name),
                nearest ? fmt::format("; did you mean '{}'?", *nearest) : std::string());
}

ConfigValue config_value(const Config& config, const ConfigKey& key) {
    Config copy = config;  // the table's accessors give places to write to
    const Field field = key.field(copy);
    if (const auto* number = std::get_if<std::uint32_t*>(&field)) return **number;
    const std::span<const std::string_view> names = choice_names(field);
    return std::visit([&](auto* choice) { return names[std::size_t(*choice)]; }, field);
}

std::string config_value_text(const Config& config, const ConfigKey& key) {
    return std::visit([](const auto& value) { return fmt::format("{}", value); }, config_value(config, key));
}

std::string describe_range(const ConfigKey& key) {
    Config any;
    const auto names = choice_names(key.field(any));
    if (!names.empty()) return quoted_list(names);
    const std::string_view kind = key.form == Form::Even         ? "an even number"
                                  : key.form == Form::PowerOfTwo ? "a power of two"
                                                                 : "a number";
    return fmt::format("{} from {} to {}", kind, key.min, key.max);
}

}  // namespace rtu::sim
