#include "study/sweep/sweep_worker.hpp"

#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/error.hpp"
#include "sim/effective_config.hpp"
#include "study/sweep/sweep_point.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<std::string> read_lines(const fs::path& path) {
    std::vector<std::string> lines;
    std::ifstream stream(path);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (lines.empty()) throw Error("{}: expected the points of a sweep, got none", path.string());
    return lines;
}

Json parse_point(const std::vector<std::string>& points, std::size_t index) {
    if (index >= points.size()) throw Error("expected a point below {}, got {}", points.size(), index);
    return Json::parse(points[index]);
}

}  // namespace

std::string point_list(const SweepPlan& plan) {
    std::string text;
    for (const SweepPoint& point : plan.points) {
        const SweepDesign& design = plan.designs[point.design];
        const std::uint64_t seed = plan.file.inputs[point.scene].seed.value_or(plan.file.seed);
        text += Json{{"id", point.id},
                     {"tree", point.tree},
                     {"level", to_string(point.level)},
                     {"tolerance", plan.file.tolerance},
                     {"seed", seed},
                     {"preset", design.preset},
                     {"sets", design.sets}}
                    .dump() +
                '\n';
    }
    return text;
}

SweepWorker::SweepWorker(const fs::path& list, const fs::path& journal)
    : folder_(list.parent_path()), points_(read_lines(list)), journal_(journal) {}

const SweepTree& SweepWorker::tree(const std::string& name) {
    if (tree_ && tree_name_ == name) return *tree_;
    tree_.reset();  // before the next one takes its memory
    tree_.emplace(folder_, name);
    tree_name_ = name;
    return *tree_;
}

std::string SweepWorker::id(std::size_t index) const { return parse_point(points_, index).at("id"); }

bool SweepWorker::run(std::size_t index) {
    const Json point = parse_point(points_, index);
    const SweepTree& shared = tree(point.at("tree"));
    const std::vector<std::string> sets = point.at("sets");
    const sim::EffectiveConfig machine = sim::load_config(point.at("preset").get<std::string>(), {}, sets);
    SweepResult result;
    try {
        const FidelityLevel level = parse_fidelity_level(point.at("level").get<std::string>());
        result = level == FidelityLevel::Cycle ? simulate_point(point.at("id"), machine.config, shared)
                                               : estimate_point(point.at("id"), machine.config, shared, level,
                                                                {point.at("tolerance"), point.at("seed")});
    } catch (const std::exception& error) {
        result = {};
        result.point = point.at("id");
        result.error = error.what();
    }
    journal_.add(to_json_line(result));
    return result.error.empty();
}

}  // namespace rtu::study
