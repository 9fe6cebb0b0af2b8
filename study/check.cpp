#include "study/check.hpp"

#include <tbb/enumerable_thread_specific.h>

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

}  // namespace

HitChecker::Verdict HitChecker::compare(const model::Ray& ray, model::RayKind kind,
                                        const std::optional<model::Hit>& hit, Scratch& scratch) const {
    Verdict verdict;
    verdict.is_reference_equal =
        model::trace(scratch.stack, scratch.mailbox, image_, ray, kind, &verdict.counts) == hit;
    verdict.is_embree_equal = is_same_answer(kind, hit, embree_.trace(ray, kind));
    return verdict;
}

model::TraversalCounts HitChecker::check(const model::Workload& workload,
                                         std::span<const std::optional<model::Hit>> hits) {
    std::vector<Verdict> verdicts(hits.size());
    tbb::enumerable_thread_specific<Scratch> scratch(Scratch{{}, model::Mailbox(mailbox_)});
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
    }
}

}  // namespace rtu::study
