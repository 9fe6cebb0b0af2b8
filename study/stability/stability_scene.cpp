#include "study/stability/stability_scene.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "model/error.hpp"
#include "model/weld.hpp"
#include "study/scene_steps.hpp"
#include "study/stability/stability_probes.hpp"

namespace rtu::study {
namespace {

using model::RandomStream;
using model::Vec3;
using model::methods::Corners;

// A scene's triangles that have area, and which of them meet at a vertex.
class SceneTriangles {
  public:
    explicit SceneTriangles(const model::TriangleMesh& mesh) {
        model::ScratchMemory memory(4096 +
                                    32 * mesh.positions.size());  // ids, and a table of four times as many
        const auto ids = model::weld_positions(mesh.positions, memory);
        first_.assign(mesh.positions.size() + 1, 0);
        for (const model::Triangle& t : mesh.triangles) {
            if (is_degenerate(mesh, t)) continue;
            triangles_.push_back({ids[t[0]], ids[t[1]], ids[t[2]]});
            corners_.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
            for (const std::uint32_t vertex : triangles_.back()) ++first_[vertex + 1];
        }
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        around_.resize(3 * triangles_.size());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t id = 0; id < triangles_.size(); ++id) {
            for (const std::uint32_t vertex : triangles_[id]) around_[next[vertex]++] = id;
        }
    }
    [[nodiscard]] bool empty() const { return triangles_.empty(); }

    // Rays start in the middle of some triangle and end wherever they are aimed; the triangles are those that
    // share a vertex with the one that is aimed at.
    [[nodiscard]] Fan draw(RandomStream& random, Target target) const {
        const std::uint32_t id = below(random), from = below(random);
        const auto& [a, b, c] = corners_[from];
        const Vec3 origin = (a + b + c) * (1.0F / 3);
        Fan fan{ray_through(origin, draw_target(random, corners_[id], target)), {}};
        for (const std::uint32_t neighbour : neighbours(id)) {
            if (neighbour != from) fan.triangles.push_back(corners_[neighbour]);
        }
        return fan;
    }

  private:
    // More triangles than a single number of 24 bits can tell apart.
    [[nodiscard]] std::uint32_t below(RandomStream& random) const {
        const float high = random.next(), low = random.next();
        const double share = double(high) + double(low) * 0x1p-24;
        return std::min(std::uint32_t(share * double(triangles_.size())),
                        std::uint32_t(triangles_.size() - 1));
    }
    [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t id) const {
        std::vector<std::uint32_t> result;
        for (const std::uint32_t vertex : triangles_[id]) {
            result.insert(result.end(), around_.begin() + first_[vertex],
                          around_.begin() + first_[vertex + 1]);
        }
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }

    std::vector<model::Triangle> triangles_;
    std::vector<Corners> corners_;
    std::vector<std::uint32_t> first_, around_;
};

}  // namespace

StabilityCase scene_case(const SceneSource& source) {
    const auto triangles = std::make_shared<const SceneTriangles>(load_scene(source).mesh);
    if (triangles->empty()) throw Error("{}: expected a triangle that has area", source.name());
    StabilityCase result{
        25, "scene", "triangles of " + source.name(), "the crossings of exact arithmetic", {}};
    constexpr std::array<std::pair<const char*, Target>, 4> targets{{{"inside", Target::Inside},
                                                                     {"edge", Target::Edge},
                                                                     {"vertex", Target::Vertex},
                                                                     {"around", Target::Around}}};
    for (const auto& [name, target] : targets) {
        result.settings.push_back(
            {source.name(), name, [=, target = target] {
                 return fan_experiment([=](RandomStream& random) { return triangles->draw(random, target); },
                                       8);
             }});
    }
    return result;
}

}  // namespace rtu::study
