#include "apps/pairing_command_plan.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "apps/common_options.hpp"
#include "apps/option_values.hpp"
#include "model/error.hpp"
#include "model/one_line.hpp"
#include "sim/presets.hpp"
#include "study/chart/chart.hpp"
#include "study/output_file.hpp"
#include "study/pairing/pairing_study.hpp"

namespace rtu::apps {
namespace {

namespace fs = std::filesystem;

std::vector<model::PairingMethod> parse_methods(std::string_view text) {
    std::vector<model::PairingMethod> methods;
    for (const std::string_view name : split(text)) {
        const model::PairingMethod method = model::parse_pairing_method(name);
        if (std::ranges::find(methods, method) != methods.end()) {
            throw Error("--methods: '{}' is given twice", to_string(method));
        }
        methods.push_back(method);
    }
    return methods;
}

std::vector<study::PairingStudyKind> parse_studies(std::string_view text) {
    std::vector<study::PairingStudyKind> kinds;
    if (text.empty()) return kinds;
    if (text == "all") {
        for (const study::PairingStudyInfo& study : study::pairing_studies()) kinds.push_back(study.kind);
        return kinds;
    }
    for (const std::string_view name : split(text)) {
        const study::PairingStudyKind kind = study::parse_pairing_study(name);
        if (std::ranges::find(kinds, kind) != kinds.end()) throw Error("--study: '{}' is given twice", name);
        kinds.push_back(kind);
    }
    return kinds;
}

std::optional<double> parse_angle(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc{} && end == text.data() + text.size();
    return is_number && std::abs(value) <= 360 ? std::optional(value) : std::nullopt;
}

study::RotationDegrees parse_rotation(std::string_view text) {
    study::RotationDegrees rotation{};
    const std::vector<std::string_view> parts = split(text);
    bool is_good = parts.size() == rotation.size();
    for (std::size_t axis = 0; is_good && axis < rotation.size(); ++axis) {
        const auto angle = parse_angle(parts[axis]);
        is_good = angle.has_value();
        rotation[axis] = angle.value_or(0) + 0.0;  // no -0
    }
    if (!is_good) {
        throw Error("--rotate: expected AX,AY,AZ in degrees from -360 to 360, got '{}'",
                    model::one_line(text));
    }
    return rotation;
}

// Each preset of an RTU with the changes that were asked for; only the study `preset` needs them.
std::vector<study::NamedMachine> load_presets(const MachineOptions& options) {
    std::vector<study::NamedMachine> machines;
    for (const std::string& name : sim::preset_names()) {
        if (name == "nv35") continue;  // it had no traversal hardware
        MachineOptions one = options;
        one.preset = name;
        machines.push_back({name, load(one)});
    }
    return machines;
}

study::PairingOptions parse_options(const PairingArguments& arguments) {
    study::PairingOptions options;
    options.baseline = model::parse_pairing_method(arguments.baseline);
    options.methods = parse_methods(arguments.methods);
    options.studies = parse_studies(arguments.studies);
    options.edge_identity = model::parse_edge_identity(arguments.edge_identity);
    options.workloads = parse_workloads(arguments.workloads);
    options.resolution = parse_resolution(arguments.resolution);
    options.rotation = parse_rotation(arguments.rotation);
    options.seed = parse_seed(arguments.seed);
    options.camera_file = optional_path(arguments.camera);
    options.preset = arguments.machine.preset;
    options.machine = load(arguments.machine);
    if (std::ranges::find(options.studies, study::PairingStudyKind::Preset) != options.studies.end()) {
        options.presets = load_presets(arguments.machine);
    }
    return options;
}

// Studies and charts tell scenes apart by their names.
void check_names(const PairingPlan& plan) {
    if (plan.options.studies.empty() && !plan.html && !plan.chart_folder) return;
    check_scene_names(plan.scenes);
}

void check_outputs(const PairingPlan& plan, const PairingArguments& arguments) {
    std::vector<fs::path> inputs(arguments.scenes.begin(), arguments.scenes.end());
    for (const std::string& name : {arguments.camera, arguments.machine.file}) {
        if (!name.empty()) inputs.emplace_back(name);
    }
    std::vector<fs::path> outputs;
    for (const auto& output : {plan.json, plan.csv, plan.html}) {
        if (!output) continue;
        check_output(*output, inputs);
        for (const fs::path& other : outputs) {
            if (is_same_file(other, *output)) throw Error("{}: is named by two options", output->string());
        }
        outputs.push_back(*output);
    }
    if (plan.chart_folder) study::check_writable_folder(*plan.chart_folder);
    if (plan.chart_folder || plan.html) study::check_gnuplot();
}

}  // namespace

PairingPlan make_pairing_plan(const PairingArguments& arguments) {
    PairingPlan plan;
    plan.options = parse_options(arguments);
    plan.scenes = parse_scenes(arguments.scenes);
    check_cameras(plan.options.camera_file, plan.scenes);
    plan.threads = arguments.threads;
    plan.is_json_to_stdout = arguments.json == "-";
    if (!plan.is_json_to_stdout) plan.json = optional_path(arguments.json);
    plan.csv = optional_path(arguments.csv);
    plan.html = optional_path(arguments.html);
    plan.chart_folder = optional_path(arguments.chart_folder);
    check_names(plan);
    check_outputs(plan, arguments);
    return plan;
}

}  // namespace rtu::apps
