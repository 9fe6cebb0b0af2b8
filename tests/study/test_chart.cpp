#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "model/error.hpp"
#include "study/chart/chart.hpp"
#include "study/chart/html_page.hpp"
#include "study/pairing/pairing_charts.hpp"
#include "study/pairing/pairing_html.hpp"
#include "tests/study/example_pairing.hpp"
#include "tests/study/gnuplot.hpp"

namespace rtu::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Chart line_chart() {
    return {"lines", "A title", "size (KiB)", "change (%)",
            true,    true,      {},           {{"bunny", {{2, -1.5}, {4, 3}}, {}, {}, 0}},
            ""};
}

TEST(ChartScript, HoldsLabelsAxesAndData) {
    const std::string script = gnuplot_script(line_chart(), ChartFormat::Svg);
    for (const char* part :
         {"'A title'", "'size (KiB)'", "'change (%)'", "logscale x 2", "2 -1.5\n4 3\n", "'bunny'"}) {
        EXPECT_THAT(script, HasSubstr(part));
    }
}

TEST(ChartScript, DashesLevelsOfOneColourApart) {
    Chart chart = line_chart();
    for (const double level : {1.0, 2.0}) chart.series.push_back({"level", {}, level, {}, 0});
    chart.series.push_back({"of another colour", {}, 3.0, {}, 1});
    const std::string script = gnuplot_script(chart, ChartFormat::Svg);
    const std::size_t first = script.find("dashtype 2"), second = script.find("dashtype 3");
    ASSERT_NE(first, std::string::npos);
    ASSERT_NE(second, std::string::npos);
    EXPECT_LT(first, second);
    EXPECT_NE(script.find("dashtype 2", second), std::string::npos);
    EXPECT_EQ(script.find("dashtype 4"), std::string::npos);
}

TEST(ChartScript, DrawsASeriesWithoutItsLine) {
    Chart chart = line_chart();
    EXPECT_THAT(gnuplot_script(chart, ChartFormat::Svg), Not(HasSubstr("with points")));
    chart.series.push_back({"places", {{3, 1}}, {}, {}, 1});
    chart.series.back().has_line = false;
    const std::string script = gnuplot_script(chart, ChartFormat::Svg);
    EXPECT_THAT(script, AllOf(HasSubstr("with linespoints"), HasSubstr("with points")));
}

// Nothing that a name can hold ends its quotes or begins a line of its own.
TEST(ChartScript, QuotesWhateverNamesHold) {
    Chart chart = line_chart();
    chart.title = "a'b\n!touch x\n`touch y` $(z) \" \xff";
    const std::string script = gnuplot_script(chart, ChartFormat::Png);
    EXPECT_THAT(script, HasSubstr("set label 1 'a\u2019b !touch x `touch y` $(z) \" \ufffd' at"));
    EXPECT_THAT(script, Not(HasSubstr("\n!")));
}

TEST(Chart, NamesRunNoCommands) {
    if (!has_gnuplot()) GTEST_SKIP() << no_gnuplot;
    const std::filesystem::path made = std::filesystem::path(testing::TempDir()) / "rtusim_chart_made_this";
    std::filesystem::remove(made);
    const std::string command = "touch " + made.string();
    Chart chart = line_chart();
    for (const std::string& name :
         {"`" + command + "`", "$(" + command + ")", "'; system('" + command + "'); '",
          "\n!" + command + "\n", "\\'\n!" + command, "END\n!" + command, std::string("@x ${x}")}) {
        chart.title = chart.x_label = chart.series[0].name = name;
        chart.groups = {name};
        EXPECT_THAT(draw(chart, ChartFormat::Svg), HasSubstr("<svg")) << name;
    }
    EXPECT_FALSE(std::filesystem::exists(made));
}

TEST(Chart, DrawsTheSameBytesEveryTime) {
    if (!has_gnuplot()) GTEST_SKIP() << no_gnuplot;
    EXPECT_EQ(draw(line_chart(), ChartFormat::Svg), draw(line_chart(), ChartFormat::Svg));
    EXPECT_THAT(draw(line_chart(), ChartFormat::Png), StartsWith("\x89PNG"));
    EXPECT_EQ(draw(line_chart(), ChartFormat::Png), draw(line_chart(), ChartFormat::Png));
}

TEST(Chart, WithoutDataIsStillAChart) {
    if (!has_gnuplot()) GTEST_SKIP() << no_gnuplot;
    EXPECT_THAT(draw({"empty", "nothing", "", "", false, false, {}, {}, ""}, ChartFormat::Svg),
                HasSubstr("no data"));
    EXPECT_THAT(
        draw({"bars", "nothing", "", "", false, false, {"a"}, {{"s", {}, {}, {}, 0}}, ""}, ChartFormat::Svg),
        HasSubstr("no data"));
}

TEST(PairingCharts, EveryOneCanBeDrawnAndHasANameOfItsOwn) {
    const PairingReport report = test::example_pairing_report();
    std::set<std::string> names;
    for (const Chart& chart : pairing_charts(report)) {
        EXPECT_TRUE(names.insert(chart.name).second) << chart.name;
        EXPECT_FALSE(chart.title.empty() || chart.y_label.empty() || chart.series.empty()) << chart.name;
        if (has_gnuplot()) {
            EXPECT_THAT(draw(chart, ChartFormat::Svg), HasSubstr("</svg>")) << chart.name;
        }
    }
    EXPECT_EQ(names.size(), 2 + pairing_studies().size() + 2);  // two methods; two studies have two charts
    if (!has_gnuplot()) GTEST_SKIP() << no_gnuplot;
}

TEST(PairingCharts, ShowTheRowsValues) {
    PairingReport report = test::example_pairing_report();
    report.rows[2].after.total.box_tests = 1000;  // hall: from 800
    const Chart bars = comparison_charts(report).front();
    EXPECT_THAT(bars.groups, testing::ElementsAre("bunny", "hall"));
    EXPECT_EQ(bars.series[0].points, (std::vector<std::pair<double, double>>{{0, -50}, {1, 25}}));
    EXPECT_EQ(bars.series[2].marks, (std::vector<std::pair<double, double>>{{0, 11.94}}));
    EXPECT_EQ(bars.mark_name, "published");
    const std::vector<Chart> window = study_charts(report, report.studies.front());
    EXPECT_EQ(window[0].series[0].points, (std::vector<std::pair<double, double>>{{2, 52}, {4, 52}}));
    EXPECT_EQ(window[1].series[2].level, 100.0);                        // edge_bbsa has no window
    EXPECT_EQ(window[1].series[2].colour, window[1].series[0].colour);  // of the same scene
    EXPECT_NE(window[1].series[1].colour, window[1].series[0].colour);
}

TEST(HtmlPage, ShowsTextAsItIs) {
    EXPECT_EQ(html_escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
    const std::string table = html_table({{"A\nB", TextTable::Align::Left}}, {{"<b>"}, {}, {"c"}});
    EXPECT_THAT(table, HasSubstr("A<br>B"));
    EXPECT_THAT(table, HasSubstr("&lt;b&gt;"));
    EXPECT_THAT(table, HasSubstr("<tr class=\"rule\"><td class=\"left\">c"));
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(PairingHtml, IsOnePageWithEveryTableAndChartAndNothingFromElsewhere) {
    if (!has_gnuplot()) GTEST_SKIP() << no_gnuplot;
    PairingReport report = test::example_pairing_report();
    report.rows[1].scene = "<script>alert(1)</script>";
    const std::string page = pairing_html(report);
    EXPECT_EQ(count_of(page, "<svg"), pairing_charts(report).size());
    EXPECT_EQ(count_of(page, "<table>"), 4 + report.studies.size());
    EXPECT_THAT(page, Not(HasSubstr("<script")));
    EXPECT_THAT(page, Not(HasSubstr("<?xml")));
    EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
    for (const char* loader : {"src=", "url(", "@import", "<link"}) EXPECT_THAT(page, Not(HasSubstr(loader)));
    EXPECT_EQ(count_of(page, "http"), count_of(page, "xmlns"));  // names of formats, which load nothing
}

// Two elements of one name would make a browser draw one chart's points in another.
TEST(PairingHtml, GivesNoIdTwice) {
    if (!has_gnuplot()) GTEST_SKIP() << no_gnuplot;
    const std::string page = pairing_html(test::example_pairing_report());
    std::set<std::string> ids;
    for (std::size_t at = page.find(" id="); at != std::string::npos; at = page.find(" id=", at + 1)) {
        const std::size_t end = page.find(page[at + 4], at + 5);
        EXPECT_TRUE(ids.insert(page.substr(at + 5, end - at - 5)).second)
            << page.substr(at + 5, end - at - 5);
    }
    EXPECT_GT(ids.size(), 10U);
}

}  // namespace
}  // namespace rtu::study
