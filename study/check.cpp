#include "study/check.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/exact_oracle.hpp"

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
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, hits.size()), [&](const auto& range) {
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

bool HitChecker::are_neighbours(const model::Ray& ray, const model::Hit& a, const model::Hit& b) const {
    const float largest =
        std::max(reach(mesh_, a.primitive_id, ray.origin), reach(mesh_, b.primitive_id, ray.origin));
    const float ulp = std::nextafter(largest, 2 * largest) - largest;
    return std::abs(a.t - b.t) * length(ray.direction) <= float(neighbour_ulps) * ulp;
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
    } else if (kind == model::RayKind::ClosestHit && hit && other && are_neighbours(ray, *hit, *other)) {
        ++report_.neighbours;
    } else {
        ++report_.embree_mismatches;
    }
}

}  // namespace rtu::study
