#include <fmt/format.h>

#include <algorithm>

#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> names_of(const Json& rows, const char* key) {
    std::vector<std::string> names;
    for (const Json& row : rows) {
        const std::string name = text_at(row, key);
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    return names;
}

PageChart mode_chart(const Json& rows, const std::string& mode) {
    PageChart chart;
    chart.title = fmt::format("Mode {}: rate against batch size", mode);
    chart.note = "Tests a second with each link. A batch that is large enough hides what a transfer costs.";
    chart.columns = {{"Link"}, {"Tests in a batch"}, {"Tests a second"}, {"Without the link"}, {"Cycles"},
                     {"Limit"}};
    bool has_batches = false;
    for (const Json& row : rows) {
        if (text_at(row, "mode") != mode) continue;
        chart.rows.push_back(cells_of(
            row, {"link", "batch_tests", "tests_per_second", "alone_tests_per_second", "cycles", "limit"}));
        has_batches = has_batches || number_at(row, "batch_tests") > 1;
    }
    if (has_batches) {
        chart.kind = PageChart::Kind::Lines;
        chart.x = 1;
        chart.group = 0;
        chart.is_x_log = true;
    }
    chart.values = {2};
    chart.is_y_log = true;
    chart.y_title = "tests a second";
    return chart;
}

PageFinding best_finding(const Json& rows, const std::string& mode) {
    const Json* best = nullptr;
    for (const Json& row : rows) {
        if (text_at(row, "mode") != mode) continue;
        if (best == nullptr || number_at(row, "tests_per_second") > number_at(*best, "tests_per_second"))
            best = &row;
    }
    return {"Mode " + mode,
            fmt::format("Fastest over {} in batches of {:.0f} tests; the limit is then: {}.",
                        text_at(*best, "link"), number_at(*best, "batch_tests"), text_at(*best, "limit")),
            {},
            fmt::format("{:.3g} tests a second, {:.3g} without the link",
                        number_at(*best, "tests_per_second"), number_at(*best, "alone_tests_per_second"))};
}

}  // namespace

PageSection stream_section(const Json& json) {
    PageSection section;
    section.title = "Streaming over a host link";
    section.note = fmt::format("Rays of {} ({}) against every pair, machine {} at {} MHz, without a BVH.",
                               text_at(json, "scene"), text_at(json, "workload"), text_at(json, "preset"),
                               json.at("clock_mhz").get<std::uint64_t>());
    const Json& rows = json.at("rows");
    for (const std::string& mode : names_of(rows, "mode")) {
        section.findings.push_back(best_finding(rows, mode));
        section.charts.push_back(mode_chart(rows, mode));
    }
    return section;
}

}  // namespace rtu::study
