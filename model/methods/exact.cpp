#include "model/methods/exact.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "model/memory_image.hpp"
#include "model/pair_test.hpp"

namespace rtu::model::methods {

namespace {

constexpr std::size_t floats_per_pair = sizeof(LeafPair) / sizeof(float);

LeafPair lone_triangle(const Corners& triangle) {
    return make_leaf_pair({.vertices = {0, 1, 2, 2}, .primitive_ids = {0, 0}}, triangle);
}

LeafPair pair_of(const Corners& first, const Corners& second) {
    const std::array<Vec3, 4> corners{first[0], first[1], first[2], second[2]};
    return make_leaf_pair({.vertices = {0, 1, 2, 3}, .primitive_ids = {0, 1}, .has_second = true}, corners);
}

template <bool IsPair>
void store(std::span<const Corners> triangles, PreparedTriangles& to) {
    to.count = triangles.size() / (IsPair ? 2 : 1);
    float* values = to.reserve(to.count * floats_per_pair);
    for (std::size_t i = 0; i < to.count; ++i, values += floats_per_pair) {
        const LeafPair pair =
            IsPair ? pair_of(triangles[2 * i], triangles[2 * i + 1]) : lone_triangle(triangles[i]);
        std::memcpy(values, &pair, sizeof pair);
    }
}

void keep_nearer(const Hit& hit, std::uint32_t triangle, RayResult& result) {
    if (result.hit_count++ > 0 && result.nearest.t <= hit.t) return;
    result.nearest = {hit.t, hit.u, hit.v};
    result.triangle = triangle;
}

template <bool IsPair>
RayResult trace_ray(const PreparedTriangles& triangles, const RaySetup& ray, bool shrinks) {
    RayResult result;
    float t_max = ray.t_max;
    const auto* pairs = reinterpret_cast<const LeafPair*>(triangles.values.get());
    for (std::uint32_t i = 0; i < triangles.count; ++i) {
        const PairHits found = test_pair(pairs[i], ray);
        for (std::uint32_t which = 0; which < (IsPair ? 2 : 1); ++which) {
            const Hit& hit = found.hits[which];
            if (!found.is_pierced[which] || !(hit.t < t_max)) continue;
            keep_nearer(hit, IsPair ? 2 * i + which : i, result);
            if (shrinks) t_max = result.nearest.t;
        }
    }
    return result;
}

template <bool IsPair>
void trace(const PreparedTriangles& triangles, std::span<const Ray> rays, bool shrinks,
           std::span<RayResult> results) {
    for (std::size_t i = 0; i < rays.size(); ++i)
        results[i] = can_hit(rays[i]) ? trace_ray<IsPair>(triangles, make_ray_setup(rays[i], Aabb{}), shrinks)
                                      : RayResult{};
}

}  // namespace

std::optional<TestHit> test_exactly(const Ray& ray, const Corners& triangle) {
    if (!can_hit(ray) || !std::all_of(triangle.begin(), triangle.end(), is_finite)) return std::nullopt;
    const PairHits found = test_pair(lone_triangle(triangle), make_ray_setup(ray, Aabb{}));
    const Hit& hit = found.hits[0];
    if (!found.is_pierced[0] || !(hit.t < ray.t_max)) return std::nullopt;
    return TestHit{hit.t, hit.u, hit.v};
}

std::vector<Kernel> exact_kernels() {
    return {{exact_info, Form::Single, 1, &store<false>, &trace<false>},
            {exact_info, Form::Pairs, 1, &store<true>, &trace<true>}};
}

}  // namespace rtu::model::methods
