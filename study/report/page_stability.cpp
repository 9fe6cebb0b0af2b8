#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "study/report/page_cells.hpp"
#include "study/report/page_sections.hpp"

namespace rtu::study {
namespace {

using Json = nlohmann::ordered_json;

struct Failed {
    double failures = 0, rays = 0;
    [[nodiscard]] double per_million() const { return rays > 0 ? 1e6 * failures / rays : 0; }
};

// Methods as compiled here; the same with fused arithmetic is another method.
std::string method_of(const Json& row) {
    const std::string method = text_at(row, "method");
    return text_at(row, "contraction") == "fast" ? method + ", fused" : method;
}

using FailedByCase = std::map<std::pair<std::string, std::string>, Failed>;  // [case, method]

FailedByCase failed_rays(const Json& json) {
    FailedByCase failed;
    for (const Json& row : json.at("rows")) {
        if (row.at("failures").is_null()) continue;
        Failed& sum = failed[{text_at(row, "case"), method_of(row)}];
        sum.failures += number_at(row, "failures");
        sum.rays += number_at(row, "rays");
    }
    return failed;
}

// In the order of the file.
std::vector<std::string> methods_of(const Json& json) {
    std::vector<std::string> names;
    std::set<std::string> known;
    for (const Json& row : json.at("rows")) {
        if (const std::string name = method_of(row); known.insert(name).second) names.push_back(name);
    }
    return names;
}

PageChart matrix(const Json& json, const FailedByCase& failed) {
    PageChart chart;
    chart.kind = PageChart::Kind::Matrix;
    chart.title = "Where methods fail";
    chart.note =
        "Failures per million rays of each case, all its settings together. Empty: none, or not measured. "
        "\"fused\": the compiler may fuse a * b + c.";
    chart.columns = {{"Case"}, {"Method"}, {"Failures per million rays", 1}, {"Rays"}};
    for (const std::string& method : methods_of(json)) {
        for (const Json& one : json.at("cases")) {
            const auto found = failed.find({text_at(one, "name"), method});
            if (found == failed.end()) continue;
            chart.rows.push_back(
                {text_at(one, "name"), method, found->second.per_million(), found->second.rays});
        }
    }
    chart.group = 1;
    chart.values = {2};
    chart.is_y_log = true;
    chart.y_title = "failures per million rays";
    return chart;
}

// The greatest 99th percentile over the settings of a case.
std::optional<PageChart> error_chart(const Json& json) {
    if (json.at("cases").empty()) return std::nullopt;
    const std::string name = text_at(json.at("cases").front(), "name");
    std::map<std::string, double> errors;
    for (const Json& row : json.at("rows")) {
        if (text_at(row, "case") != name || row.at("t_ulp_p99").is_null()) continue;
        double& error = errors[method_of(row)];
        error = std::max(error, number_at(row, "t_ulp_p99"));
    }
    PageChart chart;
    chart.title = fmt::format("Error of t, case {}", name);
    chart.note = "In units in the last place; 99 % of the hits keep to it. The worst setting of the case.";
    chart.columns = {{"Method"}, {"Error of t, ulp", 2}};
    for (const std::string& method : methods_of(json)) {
        if (errors.contains(method)) chart.rows.push_back({method, errors[method]});
    }
    if (chart.rows.empty()) return std::nullopt;
    chart.values = {1};
    chart.is_y_log = true;
    chart.y_title = "ulp";
    return chart;
}

std::vector<std::string> failed_cases(const FailedByCase& failed, const std::string& method) {
    std::vector<std::string> cases;
    for (const auto& [key, one] : failed) {
        if (key.second == method && one.failures > 0) cases.push_back(key.first);
    }
    return cases;
}

// Some cases ask what no answer in binary32 can give: there the exact test, rounded once, fails as well.
std::vector<PageFinding> method_findings(const Json& json, const FailedByCase& failed) {
    const std::vector<std::string> unavoidable = failed_cases(failed, "exact");
    const auto is_as_exact = [&](const std::string& method) {
        return std::ranges::includes(unavoidable, failed_cases(failed, method));
    };
    std::vector<std::string> good;
    const std::vector<std::string> methods = methods_of(json);
    std::ranges::copy_if(methods, std::back_inserter(good), is_as_exact);
    std::vector<PageFinding> findings;
    findings.push_back(
        {"Methods that fail only where exact arithmetic does",
         good.empty() ? "None." : fmt::format("{}.", fmt::join(good, "; ")),
         {},
         fmt::format("{} of {} methods, {} cases; the exact test, rounded once, fails in: {}", good.size(),
                     methods.size(), json.at("cases").size(),
                     unavoidable.empty() ? "none" : fmt::format("{}", fmt::join(unavoidable, ", ")))});
    if (std::ranges::find(methods, "rtu") != methods.end()) {
        const std::vector<std::string> cases = failed_cases(failed, "rtu");
        findings.push_back(
            {"rtu, the machine's pair test",
             cases.empty()        ? "It fails in no case."
             : is_as_exact("rtu") ? "It fails only where the exact test does."
                                  : "It fails where the exact test does not.",
             {},
             cases.empty() ? std::string() : fmt::format("fails in: {}", fmt::join(cases, ", "))});
    }
    return findings;
}

}  // namespace

PageSection stability_section(const Json& json) {
    PageSection section;
    section.title = "Stability";
    section.note =
        fmt::format("Ray-triangle methods against exact arithmetic; {} rays a setting, seed {}, {}.",
                    json.at("rays").get<std::uint64_t>(), json.at("seed").get<std::uint64_t>(),
                    text_at(json, "compiler"));
    const FailedByCase failed = failed_rays(json);
    section.findings = method_findings(json, failed);
    section.charts = {matrix(json, failed)};
    if (auto errors = error_chart(json)) section.charts.push_back(std::move(*errors));
    return section;
}

}  // namespace rtu::study
