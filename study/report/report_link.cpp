#include "study/report/report_link.hpp"

#include <algorithm>

#include "study/text_table.hpp"

namespace rtu::study {
namespace {

std::uint64_t value_of(const UnitReport& unit, std::string_view name) {
    const auto found = std::ranges::find(unit.counters, name, &CounterValue::name);
    return found == unit.counters.end() ? 0 : found->value;
}

// Bytes a cycle times MHz is MB/s.
std::string gigabytes_per_second(std::uint64_t bytes, const WorkloadReport& workload, std::uint32_t mhz) {
    return fixed(mrps(bytes, workload.cycles, mhz) / 1e3, 3);
}

}  // namespace

std::string link_section(const SceneReport& report) {
    TextTable table({{"Workload", TextTable::Align::Left},
                     {"Transfers\nup, down"},
                     {"Up\nGB/s"},
                     {"Down\nGB/s"},
                     {"Machine\n%"},
                     {"Read-back\n%"},
                     {"Upload\n%"},
                     {"Waiting\n%"}});
    bool has_link = false;
    for (const WorkloadReport& workload : report.workloads) {
        const auto link = std::ranges::find(workload.units, "link", &UnitReport::name);
        if (link == workload.units.end()) continue;
        has_link = true;
        const auto share = [&](std::string_view name) {
            return percent(value_of(*link, name), workload.cycles);
        };
        table.add_row(
            {workload.name,
             grouped(value_of(*link, "up_transfers")) + ", " + grouped(value_of(*link, "down_transfers")),
             gigabytes_per_second(value_of(*link, "up_bytes"), workload, report.clock_mhz),
             gigabytes_per_second(value_of(*link, "down_bytes"), workload, report.clock_mhz),
             share("machine_cycles"), share("read_back_cycles"), share("upload_cycles"),
             share("waiting_cycles")});
    }
    return has_link ? "\nHost link\n" + table.text() : "";
}

}  // namespace rtu::study
