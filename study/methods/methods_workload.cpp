#include "study/methods/methods_workload.hpp"

#include <limits>

#include "model/random.hpp"

namespace rtu::study {

namespace {

constexpr std::uint32_t for_triangles = 0x7261, for_rays = 0x7262;

model::Vec3 point(model::RandomStream& random) {
    const float x = random.next(), y = random.next(), z = random.next();
    return {x, y, z};
}

}  // namespace

MethodsWorkload random_methods_workload(std::uint32_t triangle_count, std::uint32_t ray_count,
                                        std::uint64_t seed) {
    MethodsWorkload workload;
    for (std::uint32_t i = 0; i < triangle_count / 2; ++i) {
        model::RandomStream random(seed, for_triangles, i);
        const model::Vec3 a = point(random), b = point(random), c = point(random);
        const model::Vec3 d = a + (c - b) + (point(random) - model::Vec3{0.5F, 0.5F, 0.5F}) * 0.2F;
        workload.triangles.push_back({a, b, c});
        workload.triangles.push_back({a, c, d});
    }
    for (std::uint32_t i = 0; i < ray_count; ++i) {
        model::RandomStream random(seed, for_rays, i);
        const model::Vec3 from = point(random);
        workload.rays.push_back({from, 0, point(random) - from, std::numeric_limits<float>::infinity()});
    }
    return workload;
}

}  // namespace rtu::study
