#include "study/check.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "model/parallel.hpp"

namespace rtu::study {

namespace {

std::optional<std::uint32_t> primitive(const std::optional<model::Hit>& hit) {
    return hit ? std::optional(hit->primitive_id) : std::nullopt;
}

bool is_same_answer(model::RayKind kind, const std::optional<model::Hit>& a,
                    const std::optional<model::Hit>& b) {
    return kind == model::RayKind::AnyHit ? a.has_value() == b.has_value() : primitive(a) == primitive(b);
}

// Largest coordinate of a triangle's corners, seen from the origin.
float reach(const model::TriangleMesh& mesh, std::uint32_t primitive_id, model::Vec3 origin) {
    float result = 0;
    for (const std::uint32_t vertex : mesh.triangles[primitive_id]) {
        const model::Vec3 v = mesh.positions[vertex] - origin;
        result = std::max({result, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    }
    return result;
}

float ulp_of(float value) { return std::nextafter(value, 2 * value) - value; }

std::size_t largest_axis(model::Vec3 v) {
    const float x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

// Eight ways across the ray, and two along it.
constexpr std::array<std::array<double, 3>, 10> ways_to_move{{{1, 0, 0},
                                                              {1, 1, 0},
                                                              {0, 1, 0},
                                                              {-1, 1, 0},
                                                              {-1, 0, 0},
                                                              {-1, -1, 0},
                                                              {0, -1, 0},
                                                              {1, -1, 0},
                                                              {0, 0, 1},
                                                              {0, 0, -1}}};

// Stricter than ExactHits::allows_closest(): a ray through an edge is no miss.
bool is_the_answer(const ExactHits& exact, model::RayKind kind, const std::optional<model::Hit>& hit) {
    if (kind == model::RayKind::AnyHit || !hit) return hit.has_value() == !exact.nearest.empty();
    return exact.allows_closest(hit->primitive_id);
}

// Whether the ray truly meets this triangle, nearest or not.
bool is_pierced(const model::TriangleMesh& mesh, std::uint32_t primitive_id, const model::Ray& ray) {
    model::TriangleMesh alone{mesh.name, {}, {{0, 1, 2}}};
    for (const std::uint32_t vertex : mesh.triangles[primitive_id])
        alone.positions.push_back(mesh.positions[vertex]);
    return !exact_hits(alone, ray).nearest.empty();
}

}  // namespace

HitChecker::Verdict HitChecker::compare(const model::Ray& ray, model::RayKind kind,
                                        const std::optional<model::Hit>& hit,
                                        model::Traversal& scratch) const {
    Verdict verdict;
    verdict.is_reference_equal = model::trace(scratch, image_, ray, kind, &verdict.counts) == hit;
    verdict.is_embree_equal = is_same_answer(kind, hit, embree_.trace(ray, kind));
    return verdict;
}

model::TraversalCounts HitChecker::check(const model::Workload& workload,
                                         std::span<const std::optional<model::Hit>> hits) {
    std::vector<Verdict> verdicts(hits.size());
    tbb::enumerable_thread_specific<model::Traversal> scratch;
    model::for_each_range<std::size_t>(hits.size(), 1, [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            verdicts[i] = compare(workload.rays[i], workload.ray_kind, hits[i], scratch.local());
        }
    });

    model::TraversalCounts counts;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        counts += verdicts[i].counts;
        if (!verdicts[i].is_reference_equal) ++report_.mismatches;
        if (!verdicts[i].is_embree_equal) judge(workload.rays[i], workload.ray_kind, hits[i]);
    }
    report_.compared += hits.size();
    report_.embree_compared += hits.size();
    return counts;
}

bool HitChecker::is_at_same_distance(const model::Ray& ray, const model::Hit& a, const model::Hit& b) const {
    if (!is_pierced(mesh_, a.primitive_id, ray)) return false;
    const float ulp =
        ulp_of(std::max(reach(mesh_, a.primitive_id, ray.origin), reach(mesh_, b.primitive_id, ray.origin)));
    return std::abs(a.t - b.t) * length(ray.direction) <= float(neighbour_ulps) * ulp;
}

bool HitChecker::is_right_beside(const model::Ray& ray, model::RayKind kind,
                                 const std::optional<model::Hit>& hit, const ExactHits& exact) const {
    float largest = hit ? reach(mesh_, hit->primitive_id, ray.origin) : 0.0F;
    for (const std::uint32_t id : exact.nearest) largest = std::max(largest, reach(mesh_, id, ray.origin));
    const double ulp = ulp_of(largest);
    const std::size_t z = largest_axis(ray.direction), x = (z + 1) % 3, y = (z + 2) % 3;
    for (int ulps = 1; ulps <= neighbour_ulps; ulps *= 2) {
        for (const auto& [right, up, ahead] : ways_to_move) {
            std::array<double, 3> shift{};
            shift[x] = ulp * ulps * (right + ahead * ray.direction[x] / ray.direction[z]);
            shift[y] = ulp * ulps * (up + ahead * ray.direction[y] / ray.direction[z]);
            shift[z] = ulp * ulps * ahead;
            if (is_the_answer(exact_hits(mesh_, ray, shift), kind, hit)) return true;
        }
    }
    return false;
}

void HitChecker::judge(const model::Ray& ray, model::RayKind kind, const std::optional<model::Hit>& hit) {
    const ExactHits exact = exact_hits(mesh_, ray);
    const auto allows = [&](const std::optional<model::Hit>& answer) {
        return kind == model::RayKind::AnyHit ? exact.allows_any(answer.has_value())
                                              : exact.allows_closest(primitive(answer));
    };
    const auto other = embree_.trace(ray, kind);
    const bool is_ours_right = allows(hit);
    const bool is_embree_right = allows(other);
    if (!is_embree_right) {
        ++report_.embree_wrong;
        if (!is_ours_right) ++report_.both_wrong;
    } else if (is_ours_right) {
        ++report_.ties;
    } else {
        ++report_.embree_mismatches;
        const bool is_neighbour =
            (kind == model::RayKind::ClosestHit && hit && other && is_at_same_distance(ray, *hit, *other)) ||
            is_right_beside(ray, kind, hit, exact);
        if (is_neighbour) ++report_.neighbours;
    }
}

}  // namespace rtu::study
