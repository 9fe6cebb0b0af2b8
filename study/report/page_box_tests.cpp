#include <fmt/format.h>

#include <algorithm>

#include "model/error.hpp"
#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"

namespace rtu::study {
namespace {

constexpr std::uint64_t max_cells = 65'536;

// The side of the square of pixels that a cell stands for.
std::uint32_t pixels_a_cell(std::uint32_t width, std::uint32_t height) {
    std::uint32_t side = 1;
    while (std::uint64_t{(width + side - 1) / side} * ((height + side - 1) / side) > max_cells) ++side;
    return side;
}

}  // namespace

PageSection box_tests_section(const nlohmann::ordered_json& json) {
    const auto width = json.at("width").get<std::uint32_t>(), height = json.at("height").get<std::uint32_t>();
    const auto tests = json.at("box_tests").get<std::vector<std::uint32_t>>();
    if (width == 0 || height == 0 || tests.size() != std::size_t{width} * height)
        throw Error("expected {} x {} box tests, got {}", width, height, tests.size());
    PageHeatMap map;
    map.title = fmt::format("{}: box tests of each pixel's primary ray", text_at(json, "scene"));
    map.pixels = pixels_a_cell(width, height);
    map.columns = (width + map.pixels - 1) / map.pixels;
    map.rows = (height + map.pixels - 1) / map.pixels;
    const std::size_t cells = std::size_t{map.columns} * map.rows;
    map.mean.resize(cells);
    map.greatest.resize(cells);
    std::vector<std::uint32_t> counts(cells);
    double sum = 0;
    for (std::size_t i = 0; i < tests.size(); ++i) {
        const std::size_t cell = i / width / map.pixels * map.columns + i % width / map.pixels;
        map.mean[cell] += tests[i];
        map.greatest[cell] = std::max(map.greatest[cell], tests[i]);
        ++counts[cell];
        sum += tests[i];
    }
    for (std::size_t cell = 0; cell < cells; ++cell) map.mean[cell] /= counts[cell];

    PageSection section;
    section.title = "Box tests by pixel";
    const double mean = sum / double(tests.size());
    const std::uint32_t greatest = *std::ranges::max_element(tests);
    section.findings = {
        {text_at(json, "scene"),
         fmt::format("A ray takes {:.1f} box tests on the average, and {} at most.", mean, greatest),
         {},
         fmt::format("{} x {} primary rays", width, height)}};
    section.heat_maps = {std::move(map)};
    return section;
}

}  // namespace rtu::study
