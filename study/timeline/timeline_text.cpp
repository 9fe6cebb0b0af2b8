#include <fmt/format.h>

#include <array>

#include "study/text_table.hpp"
#include "study/timeline/timeline_output.hpp"

namespace rtu::study {

namespace {

std::string unit_table(const Timeline& timeline) {
    std::vector<std::array<std::uint64_t, 4>> cycles(timeline.units.size());
    for (const UnitSpan& span : timeline.unit_spans) {
        cycles[span.unit][std::size_t(span.state)] += span.end - span.begin;
    }
    TextTable table({{"Unit", TextTable::Align::Left}, {"Busy"}, {"Starved"}, {"Blocked"}, {"Idle"}});
    for (std::size_t i = 0; i < timeline.units.size(); ++i) {
        const auto& [idle, starved, blocked, busy] = cycles[i];
        table.add_row({timeline.units[i], grouped(busy), grouped(starved), grouped(blocked), grouped(idle)});
    }
    return table.text();
}

std::string wait_table(const Timeline& timeline) {
    std::array<std::uint64_t, slot_wait_names.size()> cycles{}, spans{};
    std::uint64_t all = 0;
    for (const SlotSpan& span : timeline.slot_spans) {
        cycles[std::size_t(span.wait)] += span.end - span.begin;
        ++spans[std::size_t(span.wait)];
        all += span.end - span.begin;
    }
    TextTable table({{"At", TextTable::Align::Left}, {"Slot cycles"}, {"%"}, {"Times"}, {"Mean\ncycles"}});
    for (std::size_t i = 0; i < cycles.size(); ++i) {
        table.add_row({std::string(slot_wait_names[i]), grouped(cycles[i]), percent(cycles[i], all),
                       grouped(spans[i]), per(cycles[i], spans[i])});
    }
    return table.text();
}

}  // namespace

std::string timeline_text(const Timeline& timeline) {
    const TimelineWindow& window = timeline.window;
    return fmt::format(
        "{}, {}: cycles {} to {} of {}\n\nCycles of each unit\n{}\n"
        "Where the rays are: {} rays, {} slots, {} memory requests\n{}",
        timeline.scene, timeline.workload, grouped(window.from),
        grouped(std::min(window.end(), timeline.run_cycles)), grouped(timeline.run_cycles),
        unit_table(timeline), grouped(timeline.ray_spans.size()),
        grouped(std::uint64_t(timeline.rtu_count) * timeline.slots_per_rtu),
        grouped(timeline.requests.size()), wait_table(timeline));
}

}  // namespace rtu::study
