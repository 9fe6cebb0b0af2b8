#include "study/precision/precision_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "model/random.hpp"
#include "model/traversal.hpp"
#include "model/weld.hpp"
#include "study/fidelity/spread_sample.hpp"

namespace rtu::study {
namespace {

using model::TriangleMesh;
using model::methods::Corners;

// They tell these random numbers from those of workloads.
constexpr std::uint32_t sample_purpose = 16, aim_purpose = 17;

Corners corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
    const auto& t = mesh.triangles[triangle];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

// The primitives of every pair that a traversal tests.
std::vector<std::uint32_t> tested_triangles(model::Traversal& traversal, const model::MemoryImage& image,
                                            const model::Ray& ray, model::RayKind kind) {
    std::vector<std::uint32_t> tested;
    if (!start(traversal, image, ray, kind)) return tested;
    do {
        const model::NodeRef ref = traversal.current.ref;
        if (!ref.is_leaf()) {
            visit_node(traversal, image);
            continue;
        }
        for (std::uint32_t i = 0; i < ref.pair_count() && !is_satisfied(traversal); ++i) {
            const model::LeafPair pair = image.leaf_pair(ref, i);
            const std::uint32_t count = visit_pair(traversal, image, i).triangle_tests;
            tested.insert(tested.end(), pair.primitive_ids.begin(), pair.primitive_ids.begin() + count);
        }
    } while (!is_satisfied(traversal) && pop(traversal));
    return tested;
}

// The triangles at each vertex, vertices being one where their positions are bit-equal.
class Neighbours {
  public:
    explicit Neighbours(const TriangleMesh& mesh) : mesh_(mesh) {
        model::ScratchMemory memory(64 * mesh.positions.size() + (1U << 20));
        const auto ids = model::weld_positions(mesh.positions, memory);
        ids_.assign(ids.begin(), ids.end());
        begins_.assign(ids_.size() + 1, 0);
        for (const model::Triangle& t : mesh.triangles)
            for (const std::uint32_t vertex : t) ++begins_[ids_[vertex] + 1];
        std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
        triangles_.resize(begins_.back());
        std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
            for (const std::uint32_t vertex : mesh.triangles[i]) triangles_[next[ids_[vertex]]++] = i;
    }

    // All triangles around both; a vertex and itself are one.
    [[nodiscard]] std::vector<std::uint32_t> around(std::uint32_t vertex, std::uint32_t other) const {
        std::set<std::uint32_t> found;
        for (const std::uint32_t v : {ids_[vertex], ids_[other]})
            found.insert(triangles_.begin() + begins_[v], triangles_.begin() + begins_[v + 1]);
        return {found.begin(), found.end()};
    }

    // Whether every edge at the vertex joins two of its triangles.
    [[nodiscard]] bool is_closed(std::uint32_t vertex) const {
        const std::uint32_t id = ids_[vertex];
        std::map<std::uint32_t, int> edges;  // by their other end
        for (std::uint32_t i = begins_[id]; i < begins_[id + 1]; ++i)
            for (const std::uint32_t corner : mesh_.triangles[triangles_[i]])
                if (ids_[corner] != id) ++edges[ids_[corner]];
        return std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 2; });
    }

  private:
    const TriangleMesh& mesh_;
    std::vector<std::uint32_t> ids_;                 // of each vertex
    std::vector<std::uint32_t> begins_, triangles_;  // those of vertex v: [begins_[v], begins_[v + 1])
};

// Whether the ray runs through all triangles from the front, or through all from the back, none nearly
// edge-on: the surface around its aim is no silhouette, where two hits and none are both right.
bool is_seen_from_one_side(const RayTriangles& aimed) {
    int front = 0, back = 0;
    for (const Corners& triangle : aimed.triangles) {
        const model::Vec3 n = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
        const float along = dot(n, aimed.ray.direction);
        if (!(std::abs(along) > 0.05F * length(n) * length(aimed.ray.direction))) return false;
        ++(along < 0 ? front : back);
    }
    return front == 0 || back == 0;
}

}  // namespace

std::vector<RayTriangles> sampled_rays(const TriangleMesh& mesh, const model::MemoryImage& image,
                                       const model::Workload& workload, std::uint32_t ray_count,
                                       std::uint64_t seed) {
    std::vector<RayTriangles> rays;
    model::Traversal traversal;
    for (const std::size_t index : spread_sample(workload.rays.size(), ray_count, seed, sample_purpose)) {
        RayTriangles one{workload.rays[index], {}};
        for (const std::uint32_t triangle : tested_triangles(traversal, image, one.ray, workload.ray_kind))
            one.triangles.push_back(corners_of(mesh, triangle));
        rays.push_back(std::move(one));
    }
    return rays;
}

std::vector<RayTriangles> aimed_rays(const TriangleMesh& mesh, const model::MemoryImage& image,
                                     const model::Workload& workload, std::uint32_t ray_count,
                                     std::uint64_t seed) {
    const Neighbours neighbours(mesh);
    std::vector<RayTriangles> rays;
    model::TraversalStack stack;
    for (const std::size_t index : spread_sample(workload.rays.size(), ray_count, seed, sample_purpose)) {
        const model::Ray& ray = workload.rays[index];
        const auto hit = trace(stack, image, ray, model::RayKind::ClosestHit);
        if (!hit) continue;
        model::RandomStream random(seed, aim_purpose, std::uint32_t(index));
        const model::Triangle& t = mesh.triangles[hit->primitive_id];
        const auto side = std::size_t(random.next() * 3);
        const std::uint32_t a = t[side], b = rays.size() % 2 == 0 ? a : t[(side + 1) % 3];
        if (!neighbours.is_closed(a) || !neighbours.is_closed(b)) continue;
        const model::Vec3 from = mesh.positions[a], to = mesh.positions[b];
        const model::Vec3 aim = from + (to - from) * random.next();
        RayTriangles aimed{{ray.origin, 0, aim - ray.origin, std::numeric_limits<float>::infinity()}, {}};
        for (const std::uint32_t triangle : neighbours.around(a, b))
            aimed.triangles.push_back(corners_of(mesh, triangle));
        if (is_seen_from_one_side(aimed)) rays.push_back(std::move(aimed));
    }
    return rays;
}

}  // namespace rtu::study
