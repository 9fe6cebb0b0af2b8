#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/error.hpp"
#include "study/chart/any_chart.hpp"
#include "tests/study/gnuplot.hpp"

namespace rtu::study {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

ScatterChart example_scatter() {
    ScatterChart chart;
    chart.name = "points";
    chart.title = "A title";
    chart.is_x_logarithmic = true;
    chart.colour_floor = 1;
    chart.points = {{"it's", 1, 10, 0}, {"b", 100, 20, 5000}, {"c", 100, 20, 3}};
    return chart;
}

HeatMap example_heat_map() {
    return {"heat",
            "A title",
            "per million",
            {"a", "b"},
            {"one", "two"},
            {{HeatMap::Cell{0, "0"}, HeatMap::Cell{500, "5\"00"}}, {std::nullopt, HeatMap::Cell{1e6, "1M"}}},
            1};
}

ChartPanels example_panels() {
    Chart panel;
    panel.title = "panel";
    panel.is_x_logarithmic = true;
    panel.x_base = 10;
    panel.y_floor = 0.5;
    panel.series = {{"s", {{1, 0}, {1e7, 300}}, {}, {}, 0}, {"r", {{1, 4}}, {}, {}, 7}};
    ChartPanels panels{"panels", "A title", {panel, panel}};
    panels.panels[1].series[0].points[1].second = 9000;
    return panels;
}

PixelPanels example_pixels() {
    return {"pixels", "A title", 2, 2, {{"none", "#ff0000"}, {"some", "#00ff00"}}, {{"left", {0, 1, 1, 0}}}};
}

TEST(ScatterChart, DrawsWhatIsBelowTheFloorAtItAndNamesEveryPoint) {
    const std::string script = gnuplot_script(example_scatter(), ChartFormat::Svg);
    EXPECT_THAT(script, HasSubstr("1 10 1\n100 20 5000\n100 20 3\n"));
    EXPECT_THAT(script, HasSubstr("set label 'it\u2019s' at"));
    EXPECT_THAT(script, HasSubstr("set logscale x 10"));
    EXPECT_THAT(script, Not(HasSubstr("set logscale y")));
    EXPECT_THAT(script, HasSubstr("set cbrange [1:10000]"));
    EXPECT_THAT(script, HasSubstr("set cbtics ('0' 1"));
}

// Two names at one point are put at two places.
TEST(ScatterChart, KeepsNamesApart) {
    const std::string script = gnuplot_script(example_scatter(), ChartFormat::Svg);
    const auto place = [&](const std::string& label) {
        const std::size_t at = script.find(label);
        EXPECT_NE(at, std::string::npos) << label;
        return script.substr(at + label.size(), script.find('\n', at) - at - label.size());
    };
    EXPECT_NE(place("set label 'b'"), place("set label 'c'"));
}

TEST(HeatMapScript, TellsNoneFromSomeAndFromNotMeasured) {
    const std::string script = gnuplot_script(example_heat_map(), ChartFormat::Svg);
    EXPECT_THAT(script, HasSubstr("$none << END\n0 0 0\nEND\n"));
    EXPECT_THAT(script, HasSubstr("$coloured << END\n1 0 500\n1 1 1000000\nEND\n"));
    EXPECT_THAT(script, HasSubstr("1 0 \"5?00\"\n"));  // a quote would end the text
    EXPECT_THAT(script, HasSubstr("$light << END\n1 1 \"1M\"\nEND\n"));
    EXPECT_THAT(script, HasSubstr("set x2tics ('a' 0, 'b' 1)"));
    EXPECT_THAT(script, HasSubstr("set yrange [1.5:-0.5]"));  // the first row is at the top
}

TEST(PanelScript, GivesAllPanelsOneScaleAndZeroAPlace) {
    const std::string script = gnuplot_script(example_panels(), ChartFormat::Svg);
    EXPECT_THAT(script, HasSubstr("$panel0_series0 << END\n1 0.5\n10000000 300\nEND\n"));
    const std::string scale = "set yrange [0.357143:14400]";
    EXPECT_LT(script.find(scale), script.rfind(scale));
    EXPECT_THAT(script,
                HasSubstr("set ytics ('0' 0.5, '1' 1, '10' 10, '100' 100, '1000' 1000, '10000' 10000)"));
    EXPECT_THAT(script, HasSubstr("'1e7' 1e+07"));
    EXPECT_THAT(script, HasSubstr("dashtype 2"));  // the palette's second colour, the second time
}

TEST(PixelScript, HoldsEveryPixelAndTheLegendOnce) {
    const std::string script = gnuplot_script(example_pixels(), ChartFormat::Svg);
    EXPECT_THAT(script, HasSubstr("$panel0 << END\n0 1\n1 0\nEND\n"));
    EXPECT_THAT(script, HasSubstr("defined (0 '#ff0000', 1 '#00ff00')"));
    EXPECT_THAT(script, HasSubstr("'none' at"));
}

TEST(ChartKinds, AreDrawnInBothFormatsAndWithoutData) {
    if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot here: install gnuplot-nox";
    ScatterChart no_points;
    no_points.name = "no_points";
    const std::vector<AnyChart> charts{example_scatter(),
                                       example_heat_map(),
                                       example_panels(),
                                       example_pixels(),
                                       no_points,
                                       HeatMap{"no_cells", "", "", {}, {}, {}, 1},
                                       ChartPanels{"no_panels", "", {}}};
    for (const AnyChart& chart : charts) {
        EXPECT_THAT(draw(chart, ChartFormat::Svg), HasSubstr("</svg>")) << name_of(chart);
        EXPECT_THAT(draw(chart, ChartFormat::Png), StartsWith("\x89PNG")) << name_of(chart);
    }
}

}  // namespace
}  // namespace rtu::study
