#include "study/report/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "model/error.hpp"
#include "study/report/page_assets.hpp"
#include "study/report/page_sections.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

// Within a script element "</script" and "<!--" would end or change it.
std::string script_data(const Json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
        if (c == '<') {
            text += "\\u003c";
        } else {
            text += c;
        }
    }
    return text;
}

// The scene's name; with the file where several runs have the same scene, and numbered where that does not
// help.
std::vector<PageRun> labelled_runs(std::span<const PageInput> inputs) {
    std::map<std::string, int> scenes, labels;
    for (const PageInput& input : inputs) {
        for (const SceneReport& report : input.runs) ++scenes[report.scene.name];
    }
    std::vector<PageRun> runs;
    for (const PageInput& input : inputs) {
        for (const SceneReport& report : input.runs) {
            std::string label = report.scene.name;
            if (scenes[label] > 1)
                label += fmt::format(" ({})", std::filesystem::path(input.file).stem().string());
            if (const int times = ++labels[label]; times > 1) label += fmt::format(" {}", times);
            runs.push_back({report, label});
        }
    }
    return runs;
}

std::vector<PageSection> sections_of(std::span<const PageInput> inputs) {
    std::vector<PageSection> sections;
    const std::vector<PageRun> runs = labelled_runs(inputs);
    if (!runs.empty()) sections.push_back(runs_section(runs));
    std::map<std::string, int> kinds;
    for (const PageInput& input : inputs) ++kinds[input.kind];
    for (const PageInput& input : inputs) {
        if (!input.section) continue;
        sections.push_back(*input.section);
        if (kinds[input.kind] > 1) sections.back().title += fmt::format(" ({})", input.file);
    }
    for (std::size_t i = 0; i < sections.size(); ++i) sections[i].id = fmt::format("section-{}", i + 1);
    return sections;
}

Json page_data(std::span<const PageInput> inputs) {
    Json data{{"version", version()}, {"sources", Json::array()}, {"sections", Json::array()}};
    for (const PageInput& input : inputs)
        data["sources"].push_back({{"file", input.file}, {"kind", input.kind}});
    for (const PageSection& section : sections_of(inputs)) data["sections"].push_back(page_json(section));
    return data;
}

}  // namespace

void check_page_library() {
    if (page_assets().library.empty())
        throw Error(
            "this rtusim was built without its charting library: `./dev build` gets it where there is npm");
}

std::string report_page(std::span<const PageInput> inputs) {
    check_page_library();
    const PageAssets assets = page_assets();
    const std::map<std::string_view, std::string> parts{{"style", std::string(assets.style)},
                                                        {"script", std::string(assets.script)},
                                                        {"library", std::string(assets.library)},
                                                        {"licence", std::string(assets.licence)},
                                                        {"data", script_data(page_data(inputs))}};
    // A mark is {{name}}; what is put in its place is not searched.
    std::string page;
    std::string_view rest = assets.frame;
    for (std::size_t at = rest.find("{{"); at != std::string_view::npos; at = rest.find("{{")) {
        const std::size_t end = rest.find("}}", at);
        page += rest.substr(0, at);
        page += parts.at(rest.substr(at + 2, end - at - 2));
        rest.remove_prefix(end + 2);
    }
    return page.append(rest);
}

}  // namespace rtu::study
