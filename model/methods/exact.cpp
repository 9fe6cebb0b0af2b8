#include "model/methods/exact.hpp"

#include <algorithm>

#include "model/memory_image.hpp"
#include "model/pair_test.hpp"

namespace rtu::model::methods {

std::optional<TestHit> test_exactly(const Ray& ray, const Corners& triangle) {
    if (!can_hit(ray) || !std::all_of(triangle.begin(), triangle.end(), is_finite)) return std::nullopt;
    const TrianglePair lone{.vertices = {0, 1, 2, 2}, .primitive_ids = {0, 0}};
    Aabb bounds;
    for (const Vec3 corner : triangle) bounds.extend(corner);
    const PairHits found = test_pair(make_leaf_pair(lone, triangle), make_ray_setup(ray, bounds));
    const Hit& hit = found.hits[0];
    if (!found.is_pierced[0] || !(hit.t < ray.t_max)) return std::nullopt;
    return TestHit{hit.t, hit.u, hit.v};
}

}  // namespace rtu::model::methods
