#include "model/methods/havel_herout_sse4.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "model/methods/single_call-inl.hpp"

namespace rtu::model::methods {

#ifdef RTU_HAS_SSE4_CODE

namespace {

Sse4Triangle sse4_triangle(const Corners& corners) {
    using namespace RTU_TARGET;
    return std::bit_cast<Sse4Triangle>(
        HavelHerout::store(vector_of(corners[0]), vector_of(corners[1]), vector_of(corners[2]), Axis{}));
}

[[gnu::target("sse4.1")]] std::optional<TestHit> test_one(const Ray& ray, const Corners& triangle) {
    const Sse4Candidate found = sse4_test(sse4_ray(ray), sse4_triangle(triangle));
    if (!found.is_hit) return std::nullopt;
    const float inverse = 1 / found.det;
    return TestHit{found.t * inverse, found.u * inverse, found.v * inverse};
}

void store_all(std::span<const Corners> triangles, PreparedTriangles& to) {
    constexpr std::size_t floats = sizeof(Sse4Triangle) / sizeof(float);
    float* values = to.reserve(triangles.size() * floats);
    to.count = triangles.size();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto stored = std::bit_cast<std::array<float, floats>>(sse4_triangle(triangles[i]));
        std::copy(stored.begin(), stored.end(), values + i * floats);
    }
}

[[gnu::target("sse4.1")]] RayResult trace_one(const PreparedTriangles& triangles, const Ray& ray,
                                              bool shrinks) {
    const auto* stored = reinterpret_cast<const Sse4Triangle*>(triangles.values.get());
    Sse4Ray kept = sse4_ray(ray);
    RayResult result;
    for (std::size_t i = 0; i < triangles.count; ++i) {
        const Sse4Candidate found = sse4_test(kept, stored[i]);
        if (!found.is_hit) continue;
        const float inverse = 1 / found.det, t = found.t * inverse;
        if (result.hit_count++ != 0 && !(t < result.nearest.t)) continue;
        result.nearest = {t, found.u * inverse, found.v * inverse};
        result.triangle = std::uint32_t(i);
        if (shrinks && t < ray.t_max) kept.bounds = sse4_bounds(ray.t_min, t);
    }
    return result;
}

void trace_all(const PreparedTriangles& triangles, std::span<const Ray> rays, bool shrinks,
               std::span<RayResult> results) {
    for (std::size_t i = 0; i < rays.size(); ++i) results[i] = trace_one(triangles, rays[i], shrinks);
}

constexpr Method method{havel_herout_sse4_info, &test_one};
constexpr Kernel kernel{havel_herout_sse4_info, Form::Single, 1, &store_all, &trace_all};

bool has_sse4() { return __builtin_cpu_supports("sse4.1") != 0; }

}  // namespace

std::span<const Method> havel_herout_sse4_methods() { return {&method, has_sse4() ? 1U : 0U}; }
std::span<const Kernel> havel_herout_sse4_kernels() { return {&kernel, has_sse4() ? 1U : 0U}; }

#else

std::span<const Method> havel_herout_sse4_methods() { return {}; }
std::span<const Kernel> havel_herout_sse4_kernels() { return {}; }

#endif

}  // namespace rtu::model::methods
