#include "apps/stability_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/common_options.hpp"
#include "apps/exit_code.hpp"
#include "apps/machine_options.hpp"
#include "apps/option_values.hpp"
#include "apps/progress.hpp"
#include "apps/report_output.hpp"
#include "model/error.hpp"
#include "study/output_file.hpp"
#include "study/precision/precision_ladder.hpp"
#include "study/precision/precision_output.hpp"
#include "study/stability/stability_run.hpp"

namespace rtu::apps {
namespace {

constexpr const char* stability_description =
    "hold ray-triangle methods, the machine and Embree against exact arithmetic where methods fail:\n"
    "leaks, double hits, wrong decisions, and errors of t, u and v";

struct StabilityArguments {
    std::string methods, cases;
    std::string rays = "1000";
    std::string seed = "1";
    std::string scene;
    unsigned threads = 0;  ///< 0: all cores
    ReportOutput output;
};

std::string stability_footer() {
    std::string text = "Cases (--case NAME,...; docs/stability.md says what each is):\n";
    for (const study::StabilityCase& one : study::stability_cases()) {
        text += fmt::format("  {:>2} {:<18}{}: {}\n", one.number, one.name, one.title, one.check);
    }
    return text +
           fmt::format("\nMethods (--method NAME,...):\n  {}\n", fmt::join(study::subject_names(), ", ")) +
           "\nExamples:\n"
           "  rtusim stability                                   all methods, all cases\n"
           "  rtusim stability --case shared_vertex              one case by its parameters\n"
           "  rtusim stability --method woop,woop_top_left,rtu   some methods\n"
           "  rtusim stability --scene a.glb --rays 100000       at a scene's own triangles\n"
           "  rtusim stability --json - | jq '.rows[] | select(.leaks > 0) | .method'\n";
}

std::vector<std::string> names(const std::string& text) {
    if (text.empty()) return {};
    const auto parts = split(text);
    return {parts.begin(), parts.end()};
}

std::uint64_t parse_rays(const std::string& text) {
    std::uint64_t rays = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), rays);
    if (error != std::errc{} || end != text.data() + text.size() || rays < 1 ||
        rays > study::max_stability_rays) {
        throw Error("--rays: expected a number from 1 to {}, got '{}'", study::max_stability_rays, text);
    }
    return rays;
}

struct StabilityPlan {
    study::StabilityOptions options;
};

StabilityPlan make_plan(const StabilityArguments& arguments) {
    StabilityPlan plan;
    plan.options.methods = names(arguments.methods);
    plan.options.cases = names(arguments.cases);
    plan.options.rays = parse_rays(arguments.rays);
    plan.options.seed = parse_seed(arguments.seed);
    std::vector<std::filesystem::path> inputs;
    if (!arguments.scene.empty()) {
        plan.options.scene = parse_scenes({arguments.scene}).front();
        inputs.emplace_back(arguments.scene);
    }
    study::check_stability_options(plan.options);
    check_report_output(arguments.output, inputs);
    return plan;
}

study::StabilityReport run(StabilityPlan& plan) {
    Progress progress;
    plan.options.progress = [&progress](std::string_view scene, std::string_view phase) {
        progress.show(scene, phase);
    };
    return study::run_stability(plan.options);
}

// What the rays of the scene need: rtusim precision, on at most as many rays as it takes by itself.
std::optional<study::PrecisionReport> judge_precision(const StabilityPlan& plan) {
    if (!plan.options.scene) return std::nullopt;
    Progress progress;
    study::PrecisionOptions options;
    options.scenes = {*plan.options.scene};
    options.ray_count = std::uint32_t(std::min<std::uint64_t>(options.ray_count, plan.options.rays));
    options.seed = plan.options.seed;
    options.progress = [&](std::string_view phase) { progress.show("precision", phase); };
    return study::run_precision_study(options);
}

std::string json_of(const study::StabilityReport& report,
                    const std::optional<study::PrecisionReport>& precision) {
    using Json = nlohmann::ordered_json;
    std::string text = study::stability_json(report);
    if (!precision) return text;
    Json document = Json::parse(text);
    document["precision"] = Json::parse(study::precision_json(*precision));
    return document.dump(2) + "\n";
}

int run_stability_command(const StabilityArguments& arguments) {
    study::remove_temporaries_on_interrupt();
    StabilityPlan plan = make_plan(arguments);
    const ThreadLimit limit(arguments.threads);
    const study::StabilityReport report = run(plan);
    const std::optional<study::PrecisionReport> precision = judge_precision(plan);
    const std::string answer = precision ? "\n" + study::precision_text(*precision) : std::string();
    write_report(arguments.output, study::stability_text(report) + answer, json_of(report, precision),
                 study::stability_csv(report));
    return exit_done;
}

void add_options(CLI::App& stability, StabilityArguments& arguments) {
    stability.add_option("--method", arguments.methods, "only these methods, see below")
        ->type_name("LIST")
        ->check(is_not_empty());
    stability.add_option("--case", arguments.cases, "only these cases, see below")
        ->type_name("LIST")
        ->check(is_not_empty());
    stability
        .add_option("--rays", arguments.rays,
                    "rays a case, parameter and aim; where each is tested against more than\n"
                    "256 triangles, fewer in proportion")
        ->type_name("N")
        ->capture_default_str();
    add_seed_option(stability, arguments.seed);
    stability
        .add_option("--scene", arguments.scene,
                    "a glTF file: rays at its triangles, instead of all cases or besides those of --case,\n"
                    "and the cheapest method and number format that is exact enough for its rays")
        ->type_name("FILE")
        ->check(is_not_empty());
    add_threads_option(stability, arguments.threads);
    add_report_options(stability, arguments.output);
}

}  // namespace

void add_stability_command(CLI::App& app, std::function<int()>& command) {
    auto arguments = std::make_shared<StabilityArguments>();
    CLI::App* stability = app.add_subcommand("stability", stability_description);
    stability->footer(stability_footer());
    stability->get_formatter()->column_width(34);
    add_options(*stability, *arguments);
    stability->callback(
        [arguments, &command] { command = [arguments] { return run_stability_command(*arguments); }; });
}

}  // namespace rtu::apps
