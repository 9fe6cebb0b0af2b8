#include "study/scene_steps.hpp"

#include <chrono>

#include "model/builtin_scene.hpp"
#include "model/bvh.hpp"
#include "model/fingerprint.hpp"
#include "model/gltf.hpp"

namespace rtu::study {
namespace {

class Stopwatch {
  public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<UnitReport> reports(const std::vector<sim::UnitResult>& units) {
    std::vector<UnitReport> result;
    for (const sim::UnitResult& unit : units) {
        UnitReport& report = result.emplace_back(UnitReport{unit.name, unit.cycles, {}});
        for (const sim::CounterValue& c : unit.counters) {
            report.counters.push_back({std::string(c.name), std::string(c.unit), c.value});
        }
    }
    return result;
}

}  // namespace

LoadedScene load_scene(const SceneSource& source) {
    LoadedScene scene{source.file ? model::load_gltf(*source.file) : model::builtin_scene(), {}, {}};
    const model::TriangleMesh& mesh = scene.mesh;
    scene.facts = {source.name(), mesh.triangles.size(), mesh.positions.size(),
                   model::count_degenerate(mesh)};
    scene.input_hash = model::hex_digits(model::fingerprint(mesh));
    return scene;
}

BuiltScene build_scene(const model::TriangleMesh& mesh, model::PairingMethod method,
                       model::EdgeIdentity identity, const sim::Config::Bvh& bvh) {
    BuiltScene built;
    const Stopwatch pairing_watch;
    const model::Pairing pairing = model::pair_triangles(mesh, method, identity);
    built.pairing = {model::to_string(method), std::string(model::to_string(identity)),
                     pairing.paired_percent(), pairing.pair_count,
                     pairing.single_count,     pairing_watch.seconds()};
    const Stopwatch build_watch;
    built.image = model::build_bvh(
        mesh, pairing,
        {bvh.width, bvh.max_leaf_pairs, bvh.node_format, bvh.splits, bvh.split_budget_percent, bvh.builder});
    const model::MemoryImage& image = built.image;
    built.bvh = {image.width,           std::string(to_string(image.format)),
                 image.node_bytes(),    image.node_count,
                 image.leaf_count,      image.size_bytes(),
                 build_watch.seconds(), image.reference_count - image.pair_count};
    model::validate(image, mesh);
    return built;
}

ChosenCamera choose_camera(const model::TriangleMesh& mesh, const model::MemoryImage& image,
                           const SceneSource& source,
                           const std::optional<std::filesystem::path>& camera_file) {
    if (camera_file) {
        if (const auto camera = model::load_camera(*camera_file, source.name())) {
            return {*camera, camera_file->filename().string()};
        }
    }
    if (!source.file) return {model::builtin_camera(), "built-in"};
    return {model::automatic_camera(mesh, image), "automatic"};
}

WorkloadReport workload_report(const std::string& name, std::uint64_t hit_count,
                               const sim::MachineResult& result) {
    WorkloadReport report;
    report.name = name;
    report.ray_count = result.ray_count;
    report.hit_count = hit_count;
    report.box_tests = result.counts.box_tests;
    report.node_visits = result.counts.node_visits;
    report.pair_tests = result.counts.pair_tests;
    report.triangle_tests = result.counts.triangle_tests;
    report.cycles = result.cycles;
    report.units = reports(result.units);
    report.memory = reports(result.memory);
    return report;
}

}  // namespace rtu::study
