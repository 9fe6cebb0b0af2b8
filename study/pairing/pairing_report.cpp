#include "study/pairing/pairing_report.hpp"

#include <algorithm>

#include "model/error.hpp"

namespace rtu::study {
namespace {

using Value = std::optional<double>;

// The change of one number of a PairingRun.
template <auto number>
Value change(const PairingRow& row) {
    return change_percent(double(number(row.before)), double(number(row.after)));
}

constexpr std::array columns = std::to_array<PairingColumn>({
    {"seconds", "Time\ns", false, true,
     [](const PairingRow& row) -> Value { return row.after.pairing.seconds; }},
    {"old_paired_percent", "Old pairs\n%", false, false,
     [](const PairingRow& row) -> Value { return row.before.pairing.paired_percent; }},
    {"new_paired_percent", "New pairs\n%", false, false,
     [](const PairingRow& row) -> Value { return row.after.pairing.paired_percent; }},
    {"delta_box_percent", "Box tests\nchange %", true, false,
     change<[](const PairingRun& run) { return run.total.box_tests; }>},
    {"delta_tri_percent", "Tri tests\nchange %", true, false,
     change<[](const PairingRun& run) { return run.total.pair_tests; }>},
    {"delta_mrps_percent", "MRPS\nchange %", true, false,
     change<[](const PairingRun& run) { return run.mrps(); }>},
    {"delta_image_bytes_percent", "Image bytes\nchange %", true, false,
     change<[](const PairingRun& run) { return run.bvh.image_bytes; }>},
    {"delta_bvh_build_seconds_percent", "BVH build\nchange %", true, true,
     change<[](const PairingRun& run) { return run.bvh.build_seconds; }>},
    {"delta_l1_misses_percent", "L1 misses\nchange %", true, false,
     change<[](const PairingRun& run) { return run.l1_misses; }>},
    {"delta_l2_misses_percent", "L2 misses\nchange %", true, false,
     change<[](const PairingRun& run) { return run.l2_misses; }>},
    {"delta_dram_bytes_percent", "DRAM bytes\nchange %", true, false,
     change<[](const PairingRun& run) { return run.dram_bytes; }>},
});

}  // namespace

std::optional<double> change_percent(double before, double after) {
    if (before == after) return 0.0;
    if (before == 0) return std::nullopt;
    return 100.0 * (after - before) / before;
}

std::span<const PairingColumn> pairing_columns() { return columns; }

const PairingColumn& pairing_column(std::string_view key) {
    const auto found = std::ranges::find(columns, key, &PairingColumn::key);
    RTU_CHECK(found != columns.end(), "no pairing column is called {}", key);
    return *found;
}

std::optional<double> average(std::span<const PairingRow> rows, std::string_view method,
                              const PairingColumn& column) {
    double sum = 0;
    int count = 0;
    for (const PairingRow& row : rows) {
        if (row.method != method) continue;
        const Value value = column.value(row);
        sum += value.value_or(0);
        count += value ? 1 : 0;
    }
    return count > 0 ? Value(sum / count) : std::nullopt;
}

}  // namespace rtu::study
