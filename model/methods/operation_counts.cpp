#include "model/methods/operation_counts.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "model/methods/single_call-inl.hpp"
#include "model/vec3.hpp"

namespace rtu::model::methods {
namespace {

using namespace RTU_TARGET;

using Tally = Counted::Tally;

// What `run` does, counted.
template <class Run>
Tally counted(Run run) {
    Counted::tally() = {};
    run();
    return std::exchange(Counted::tally(), Tally{});
}

Vector<Counted> counted_vector(const Vector<float>& v) {
    return {{Counted(v[0]), Counted(v[1]), Counted(v[2])}};
}

// Cheaper in multiplications, additions and divisions, then in the rest.
bool is_less(const OperationCounts& a, const OperationCounts& b) {
    const auto key = [](const OperationCounts& c) {
        return std::pair(c.mul + c.add + c.div, c.compare + c.sign);
    };
    return key(a) < key(b);
}

// The least and the greatest of some counts.
struct Extremes {
    std::optional<OperationCounts> least, greatest;
    void add(const OperationCounts& counts) {
        if (!least || is_less(counts, *least)) least = counts;
        if (!greatest || is_less(*greatest, counts)) greatest = counts;
    }
};

struct DirectedRay {
    Vector<float> origin, direction;
    float t_min, t_max;
};

constexpr Vector<float> corner_a{{0.1F, 0.2F, 3.1F}}, corner_b{{1.3F, 0.1F, 2.9F}},
    corner_c{{0.3F, 1.2F, 3.3F}};
constexpr Vector<float> beside{{-0.9F, 1.1F, 3.2F}};  // across the edge a-c
constexpr Vector<float> folded{{1.1F, 0.3F, 3.9F}};   // on the side of b

// Inside the triangle and out of it on every side, in three intervals: all, before it, behind it.
std::vector<DirectedRay> directed_rays() {
    std::vector<DirectedRay> rays;
    const Vector<float> origin{{0.2F, 0.15F, -0.3F}};
    for (const float u : {-1.7F, -0.4F, 0.3F, 0.35F, 1.8F})
        for (const float v : {-1.6F, -0.3F, 0.25F, 1.9F}) {
            const Vector<float> aim = corner_a * (1 - u - v) + corner_b * u + corner_c * v;
            for (const auto& [t_min, t_max] : {std::pair(0.0F, infinity), {0.0F, 0.5F}, {2.0F, infinity}})
                rays.push_back({origin, aim - origin, t_min, t_max});
        }
    return rays;
}

template <class M>
struct CountedRay {
    Axis axis;
    typename M::template RayData<Counted> data;
    Interval<Counted> interval;
    explicit CountedRay(const DirectedRay& ray)
        : axis(axis_of_ray(M::info, ray.direction)),
          data(M::prepare(counted_vector(ray.origin), counted_vector(ray.direction), axis)),
          interval{Counted::bound(ray.t_min), Counted::bound(ray.t_max)} {}
};

template <class M>
SingleCounts single_counts(const Vector<float>& a, const Vector<float>& b, const Vector<float>& c) {
    const Axis of_triangle = axis_of_triangle(M::info, a, b, c);
    const auto stored = M::store(counted_vector(a), counted_vector(b), counted_vector(c), of_triangle);
    Extremes misses, hits, full;
    for (const DirectedRay& directed : directed_rays()) {
        const CountedRay<M> ray(directed);
        const Axis axis = M::info.axis_owner == AxisOwner::Ray ? ray.axis : of_triangle;
        Candidate<Counted> candidate{};
        const Tally test = counted([&] { candidate = M::test(ray.data, ray.interval, stored, axis); });
        const OperationCounts total = test.own + test.interval;
        if (!candidate.is_hit) {
            misses.add(total);
            continue;
        }
        const Tally finish = counted([&] { (void)M::finish(candidate); });
        hits.add(total + finish.own);
        full.add(test.own);
    }
    return {misses.least.value(), misses.greatest.value(), hits.greatest.value(), full.greatest.value()};
}

template <class M>
PairCounts pair_counts(const Vector<float>& a, const Vector<float>& b, const Vector<float>& c) {
    std::array<Extremes, 3> totals, fulls;  // by the number of hits
    for (const bool is_folded : {false, true}) {
        const Vector<float>& d = is_folded ? folded : beside;
        const auto stored =
            M::store_pair(counted_vector(a), counted_vector(b), counted_vector(c), counted_vector(d), Axis{});
        for (const DirectedRay& directed : directed_rays()) {
            const CountedRay<M> ray(directed);
            PairCandidate<Counted> found{};
            const Tally test =
                counted([&] { found = M::test_pair(ray.data, ray.interval, stored, ray.axis); });
            const Tally finish = counted([&] {
                if (found.first.is_hit) (void)M::finish(found.first);
                if (found.second.is_hit) (void)M::finish(found.second);
            });
            const auto hits = std::size_t(found.first.is_hit) + std::size_t(found.second.is_hit);
            totals[hits].add(test.own + test.interval + finish.own);
            // A ray that passes both triangles of a folded pair, one of them out of the interval, takes what
            // two hits take: not what is asked here.
            if (hits != 1 || !is_folded) fulls[hits].add(test.own);
        }
    }
    return {totals[0].least.value(), totals[1].least.value(), fulls[1].least.value(),
            totals[2].greatest.value(), fulls[2].greatest.value()};
}

template <class M>
MethodCounts counts_of_method() {
    const Vector<float>&a = corner_a, &b = corner_c, &c = corner_b;  // its front is seen
    MethodCounts counts;
    counts.name = M::info.name;
    counts.single = single_counts<M>(a, b, c);
    const Axis axis = axis_of_triangle(M::info, a, b, c);
    const auto p = counted_vector(a), q = counted_vector(b), r = counted_vector(c);
    counts.precomputation = counted([&] { (void)M::store(p, q, r, axis); }).own;
    if constexpr (requires { requires M::has_pair; }) {
        counts.pair = pair_counts<M>(corner_a, corner_b, corner_c);
        const auto s = counted_vector(beside);
        counts.pair_precomputation = counted([&] { (void)M::store_pair(p, q, r, s, axis); }).own;
    }
    return counts;
}

template <class... Methods>
std::vector<MethodCounts> counts_of_all(MethodList<Methods...>) {
    return {counts_of_method<Methods>()...};
}

}  // namespace

std::span<const MethodCounts> operation_counts() {
    static const std::vector<MethodCounts> counts = counts_of_all(AllMethods());
    return counts;
}

const MethodCounts* counts_of(std::string_view name) {
    const auto all = operation_counts();
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.name == name; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace rtu::model::methods
