#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "model/error.hpp"
#include "study/chart/chart_study.hpp"
#include "study/methods/method_charts.hpp"
#include "study/methods/method_charts_rows.hpp"
#include "tests/study/gnuplot.hpp"

namespace rtu::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Points = std::vector<std::pair<double, double>>;

StabilityRow stability_row(const char* method, std::size_t case_index, const char* parameter, const char* aim,
                           std::uint64_t leaks, const char* contraction = "off") {
    StabilityRow row{method, contraction, case_index, parameter, aim, {}, {}};
    row.measured.crossings = row.measured.doubles = row.measured.triangles = true;
    row.tally.rays = 1000;
    row.tally.leaks = leaks;
    for (int i = 1; i <= 100; ++i) row.tally.t_ulp.add(i * 0.01);
    return row;
}

StabilityReport example_stability() {
    StabilityReport report;
    report.cases = {{1, "shared_edge", "", ""}, {3, "far_offset", "", ""}, {21, "compiler", "", ""}};
    for (const char* method : {"wald", "woop"}) {
        const bool is_wald = method == std::string_view("wald");
        report.rows.push_back(stability_row(method, 0, "cube", "edge", is_wald ? 5 : 0));
        report.rows.push_back(stability_row(method, 1, "0", "random", is_wald ? 1 : 0));
        report.rows.push_back(stability_row(method, 1, "1e3", "random", 0));
        report.rows.push_back(stability_row(method, 2, "", "all", 900, "fast"));
    }
    return report;
}

MethodsRow speed_row(const char* method, model::methods::Form form, std::uint32_t width, double speed) {
    MethodsRow row;
    row.kernel.method = model::methods::find_method(method)->info;
    row.kernel.form = form;
    row.kernel.width = width;
    row.workload = "random";
    row.tests_per_second = speed * 1e6;
    return row;
}

MethodsReport example_speeds() {
    using model::methods::Form;
    MethodsReport report;
    report.rows = {speed_row("wald", Form::Triangles, 8, 900), speed_row("wald", Form::Triangles, 4, 500),
                   speed_row("woop", Form::Triangles, 8, 700), speed_row("wald", Form::Rays, 4, 470),
                   speed_row("wald", Form::Single, 1, 79),     speed_row("badouel", Form::Rays, 4, 1)};
    return report;
}

PrecisionReport example_precision() {
    PrecisionReport report;
    for (const int bits : {7, 15, 23}) {
        PrecisionRow row;
        row.scene = "hall";
        row.method = "wald";
        row.format = {8, std::uint8_t(bits)};
        row.rays = 1000;
        row.lost = bits == 7 ? 900 : bits == 15 ? 3 : 0;
        row.area = double(bits);
        row.is_enough = bits > 7;
        report.rows.push_back(row);
    }
    PrecisionAnswer answer;
    answer.scene = "hall";
    answer.rays = 1000;
    answer.row = 1;
    report.scenes.push_back(answer);
    return report;
}

TEST(MethodCharts, SpeedIsOverTheErrorOfTAndColouredByLeaks) {
    const ScatterChart chart = speed_chart(example_speeds(), example_stability());
    ASSERT_EQ(chart.points.size(), 2U);
    EXPECT_EQ(chart.points[0].name, "Wald");
    EXPECT_EQ(chart.points[0].y, 900);
    EXPECT_NEAR(chart.points[0].x, 0.99, 0.02);
    EXPECT_EQ(chart.points[0].colour, 5000);  // of a million; the rows far from the origin do not count
    EXPECT_EQ(chart.points[1].colour, 0);
}

TEST(MethodCharts, FailuresLeaveOutContractedCodeAndCasesWithoutRows) {
    const HeatMap map = failure_chart(example_stability());
    EXPECT_THAT(map.columns, ElementsAre("shared_edge", "far_offset"));
    EXPECT_THAT(map.rows, ElementsAre("Wald", "Woop"));
    EXPECT_EQ(map.cells[0][0]->value, 5000);
    EXPECT_EQ(map.cells[0][0]->text, "5.0k");
    EXPECT_EQ(map.cells[0][1]->value, 500);  // 1 of 2,000 rays
    EXPECT_EQ(map.cells[1][0]->text, "0");
    EXPECT_EQ(map.floor, 100);
}

TEST(MethodCharts, OffsetsHaveAPanelAnAimAndALineAMethod) {
    const std::vector<OffsetRow> rows{{"wald", 1, "edge", 1000, 1, 2},
                                      {"woop", 1, "edge", 1000, 0, 0},
                                      {"wald", 10, "edge", 1000, 4, 0},
                                      {"woop", 1, "vertex", 1000, 0, 7}};
    const ChartPanels panels = offset_chart(rows);
    ASSERT_EQ(panels.panels.size(), 2U);
    EXPECT_EQ(panels.panels[0].series[0].points, (Points{{1, 3000}, {10, 4000}}));
    EXPECT_EQ(panels.panels[1].series[1].points, (Points{{1, 7000}}));
    EXPECT_EQ(panels.panels[0].series.size(), panels.panels[1].series.size());
    EXPECT_EQ(panels.panels[0].y_floor, 400);  // below one of a thousand rays
}

TEST(MethodCharts, ErrorsRiseToAllHits) {
    const ChartPanels panels = error_chart(example_stability());
    for (const Chart& panel : panels.panels) {
        ASSERT_EQ(panel.series.size(), 2U);
        const Points& line = panel.series[0].points;
        ASSERT_EQ(line.size(), 100U);
        EXPECT_TRUE(std::ranges::is_sorted(line));
        EXPECT_NEAR(line[49].first, 0.5, 0.01);
        EXPECT_EQ(line.back(), (std::pair<double, double>{1, 100}));
    }
}

TEST(MethodCharts, WidthsStandBesideThePublishedOnes) {
    const Chart chart = width_chart(example_speeds());
    ASSERT_EQ(chart.series.size(), 2U);
    EXPECT_EQ(chart.series[0].points, (Points{{1, 79}, {4, 470}}));
    EXPECT_EQ(chart.series[1].name, "Wald, published");
    EXPECT_EQ(chart.series[1].points, (Points{{1, 109}, {4, 390}}));
    EXPECT_EQ(chart.series[1].colour % 6, chart.series[0].colour % 6);
}

TEST(MethodCharts, PrecisionIsWrongRaysOverArea) {
    const Chart chart = precision_chart(example_precision());
    ASSERT_EQ(chart.series.size(), 1U);
    EXPECT_EQ(chart.series[0].points, (Points{{7, 900'000}, {15, 3000}, {23, 0}}));
    EXPECT_EQ(chart.y_floor, 400);
}

TEST(MethodCharts, ParityTellsLeaksFromEvenNumbers) {
    const std::vector<ParityMap> maps{{"woop", {0, 1, 2, 3}}};
    const PixelPanels panels = parity_chart(maps, 2, 2);
    EXPECT_THAT(panels.panels[0].pixels, ElementsAre(0, 2, 1, 2));
    EXPECT_EQ(panels.panels[0].title, "Woop: 1 red, 1 yellow");
}

TEST(MethodCharts, OperationsAreOfOneTriangleTwoAndThePair) {
    const Chart chart = operation_chart(model::methods::operation_counts());
    const auto group = std::ranges::find(chart.groups, "Woop") - chart.groups.begin();
    ASSERT_LT(group, std::ssize(chart.groups));
    const auto bar = [&](std::size_t i) { return chart.series[i].points[std::size_t(group)].second; };
    EXPECT_EQ(bar(0), 16 + 22);
    EXPECT_EQ(bar(1), 32 + 44);
    EXPECT_EQ(bar(2), 26 + 33);
    EXPECT_EQ(bar(3), 22 + 29);
}

TEST(ParityMaps, ShowLeaksOfMollerTrumboreAndNoneOfTheExactTest) {
    const std::vector<std::string> methods{"moller_trumbore", "exact"};
    const std::vector<ParityMap> maps = parity_maps(methods, 40, 40);
    EXPECT_GT(std::ranges::count(maps[0].hits, 0U), 10);
    EXPECT_TRUE(std::ranges::all_of(maps[1].hits, [](std::uint32_t hits) { return hits % 2 == 1; }));
}

TEST(Offsets, AreTheSameForTheSameSeedAndTheExactTestNeverFails) {
    const std::vector<OffsetRow> rows = measure_offsets(20, 3), again = measure_offsets(20, 3);
    int failures = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].leaks, again[i].leaks);
        EXPECT_EQ(rows[i].doubles, again[i].doubles);
        if (rows[i].method == "exact") {
            EXPECT_EQ(rows[i].leaks + rows[i].doubles, 0U) << rows[i].offset << " " << rows[i].aim;
        }
        failures += rows[i].leaks + rows[i].doubles > 0 ? 1 : 0;
    }
    EXPECT_GT(failures, 100);
}

TEST(ChartStudy, KnowsItsChartsByName) {
    std::set<std::string_view> names;
    for (const ChartInfo& chart : known_charts()) EXPECT_TRUE(names.insert(chart.name).second);
    EXPECT_EQ(names.size(), 8U);
    EXPECT_NO_THROW(check_chart_names({"speed", "parity"}));
    EXPECT_THROW(check_chart_names({"sped"}), Error);
    EXPECT_THROW(check_chart_names({"speed", "speed"}), Error);
}

ChartData example_data() {
    ChartData data;
    data.leaf_speeds = example_speeds();
    data.packet_speeds = example_speeds();
    data.stability = example_stability();
    data.precision = example_precision();
    data.offsets = {{"wald", 1, "edge", 1000, 1, 2}, {"wald", 1, "vertex", 1000, 0, 7}};
    data.parity = {{"woop", {0, 1, 2, 3}}};
    data.parity_size = 2;
    return data;
}

TEST(ChartStudy, MakesOneSelfContainedPageOfAllCharts) {
    if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot here: install gnuplot-nox";
    const ChartOptions options;
    const std::vector<NamedChart> charts = make_charts(options, example_data());
    EXPECT_EQ(charts.size(), known_charts().size());
    const std::string page = charts_html(options, charts);
    std::size_t figures = 0;
    for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1))
        ++figures;
    EXPECT_EQ(figures, charts.size());
    for (const char* loader : {"src=", "url(", "@import", "<link", "href=\"http", "href='http"}) {
        EXPECT_THAT(page, Not(HasSubstr(loader)));
    }
    std::set<std::string> ids;
    for (std::size_t at = page.find(" id="); at != std::string::npos; at = page.find(" id=", at + 1)) {
        const std::size_t end = page.find(page[at + 4], at + 5);
        EXPECT_TRUE(ids.insert(page.substr(at + 5, end - at - 5)).second) << page.substr(at, 40);
    }
}

}  // namespace
}  // namespace rtu::study
