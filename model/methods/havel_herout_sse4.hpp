#pragma once

#include <span>

#include "model/methods/kernel.hpp"
#include "model/methods/method.hpp"

#if defined(__x86_64__) || defined(__i386__)
#define RTU_HAS_SSE4_CODE 1
#include <smmintrin.h>
#endif

// Havel-Herout's test of one ray and one triangle in SSE4.1, whose DPPS takes each of its dot products;
// [HH11] section IV. Against the listing there: `pt` is detp, `helper` is int_coef_arr, the hit returns true,
// the reciprocal is a true division (RCPSS would lose half of the digits), and comparisons are inclusive, so
// that -0 counts as 0. Results are havel_herout's but for rounding, as DPPS adds in another order.

namespace rtu::model::methods {

inline constexpr MethodInfo havel_herout_sse4_info{.name = "havel_herout_sse4",
                                                   .title = "Havel-Herout, SSE4",
                                                   .source = "[HH11] section IV",
                                                   .stored_bytes = 48};

/// The method, or nothing where the processor has no SSE4.1.
[[nodiscard]] std::span<const Method> havel_herout_sse4_methods();
/// Its kernel: Form::Single. Nothing where the processor has no SSE4.1.
[[nodiscard]] std::span<const Kernel> havel_herout_sse4_kernels();

#ifdef RTU_HAS_SSE4_CODE

/// HavelHerout::Stored as it lies: three planes of 16 bytes.
struct alignas(16) Sse4Triangle {
    float n[4], n_1[4], n_2[4];
};

struct Sse4Ray {
    __m128 origin, minus_origin, direction;  ///< fourth components 1, 1, 0
    __m128 bounds;                           ///< t_min, -t_max, twice
};

/// t, u, v times det where is_hit is set; det is not negative.
struct Sse4Candidate {
    bool is_hit;
    float t, u, v, det;
};

[[nodiscard, gnu::target("sse4.1")]] inline __m128 sse4_bounds(float t_min, float t_max) {
    return _mm_set_ps(-t_max, t_min, -t_max, t_min);
}

[[nodiscard, gnu::target("sse4.1")]] inline Sse4Ray sse4_ray(const Ray& ray) {
    const Vec3 &o = ray.origin, &d = ray.direction;
    return {_mm_set_ps(1, o.z, o.y, o.x), _mm_set_ps(1, -o.z, -o.y, -o.x), _mm_set_ps(0, d.z, d.y, d.x),
            sse4_bounds(ray.t_min, ray.t_max)};
}

[[nodiscard, gnu::target("sse4.1")]] inline Sse4Candidate sse4_test(const Sse4Ray& ray,
                                                                    const Sse4Triangle& triangle) {
    const __m128 sign_bits = _mm_set1_ps(-0.0F), odd_sign_bits = _mm_set_ps(-0.0F, 0, -0.0F, 0);
    const __m128 n = _mm_load_ps(triangle.n);
    const __m128 det = _mm_dp_ps(n, ray.direction, 0x7F);
    const __m128 t_det = _mm_dp_ps(n, ray.minus_origin, 0xFF);
    // What most tests end with: t det - t_min det or t_max det - t det has not the sign of det.
    const __m128 both_ways = _mm_xor_ps(t_det, odd_sign_bits);
    const __m128 inside = _mm_sub_ps(both_ways, _mm_mul_ps(ray.bounds, det));
    if (_mm_movemask_ps(_mm_xor_ps(inside, det)) != 0) return {false, 0, 0, 0, 0};
    const __m128 sign = _mm_and_ps(det, sign_bits), size = _mm_andnot_ps(sign_bits, det);
    const __m128 distance = _mm_xor_ps(t_det, sign);
    const __m128 is_within = _mm_cmpgt_ps(_mm_xor_ps(both_ways, sign), _mm_mul_ps(ray.bounds, size));
    if (_mm_movemask_ps(is_within) != 0xF) return {false, 0, 0, 0, 0};
    const __m128 point = _mm_add_ps(_mm_mul_ps(ray.origin, det), _mm_mul_ps(ray.direction, t_det));
    const __m128 u = _mm_xor_ps(_mm_dp_ps(point, _mm_load_ps(triangle.n_1), 0xF1), sign);
    const __m128 zero = _mm_setzero_ps();
    if (!(_mm_comige_ss(u, zero) && _mm_comile_ss(u, size))) return {false, 0, 0, 0, 0};
    const __m128 v = _mm_xor_ps(_mm_dp_ps(point, _mm_load_ps(triangle.n_2), 0xF1), sign);
    if (!(_mm_comige_ss(v, zero) && _mm_comile_ss(_mm_add_ss(u, v), size))) return {false, 0, 0, 0, 0};
    return {true, _mm_cvtss_f32(distance), _mm_cvtss_f32(u), _mm_cvtss_f32(v), _mm_cvtss_f32(size)};
}

#endif

}  // namespace rtu::model::methods
