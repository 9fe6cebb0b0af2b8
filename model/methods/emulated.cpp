#include "model/methods/emulated.hpp"

#include <fmt/format.h>

#include <type_traits>
#include <vector>

#include "model/methods/single_call-inl.hpp"

namespace rtu::model::methods {
namespace {

using RTU_TARGET::Axis;
using RTU_TARGET::Vector;

Vector<Emulated> emulated(NumberFormat format, Vec3 v) {
    return {{{format, double(v.x)}, {format, double(v.y)}, {format, double(v.z)}}};
}

template <class M>
std::optional<EmulatedHit> test_emulated(const Ray& ray, const Corners& triangle, NumberFormat format) {
    const auto a = emulated(format, triangle[0]), b = emulated(format, triangle[1]),
               c = emulated(format, triangle[2]);
    const auto direction = emulated(format, ray.direction);
    const Axis of_ray = RTU_TARGET::axis_of_ray(M::info, direction);
    const Axis of_triangle = RTU_TARGET::axis_of_triangle(M::info, a, b, c);
    const auto kept = M::prepare(emulated(format, ray.origin), direction, of_ray);
    const auto stored = M::store(a, b, c, of_triangle);
    const RTU_TARGET::Interval<Emulated> interval{{format, double(ray.t_min)}, {format, double(ray.t_max)}};
    const Axis axis = M::info.axis_owner == AxisOwner::Ray ? of_ray : of_triangle;
    const auto candidate = M::test(kept, interval, stored, axis);
    if (!candidate.is_hit) return std::nullopt;
    const auto hit = M::finish(candidate);
    return EmulatedHit{hit.t.value, hit.u.value, hit.v.value};
}

template <class... Methods>
std::vector<EmulatedMethod> emulations_of(RTU_TARGET::MethodList<Methods...>) {
    std::vector<EmulatedMethod> all;
    const auto add = [&]<class M>(std::type_identity<M>) {
        if constexpr (!std::is_same_v<M, RTU_TARGET::WoopExact>) all.push_back({M::info, &test_emulated<M>});
    };
    (add(std::type_identity<Methods>()), ...);
    return all;
}

float narrowed(NumberFormat format, float x) { return float(rounded(format, double(x))); }

Vec3 narrowed(NumberFormat format, Vec3 v) {
    return {narrowed(format, v.x), narrowed(format, v.y), narrowed(format, v.z)};
}

}  // namespace

std::span<const EmulatedMethod> emulated_methods() {
    static const std::vector<EmulatedMethod> methods = emulations_of(RTU_TARGET::AllMethods());
    return methods;
}

Ray rounded(NumberFormat format, const Ray& ray) {
    return {narrowed(format, ray.origin), narrowed(format, ray.t_min), narrowed(format, ray.direction),
            narrowed(format, ray.t_max)};
}

Corners rounded(NumberFormat format, const Corners& triangle) {
    return {narrowed(format, triangle[0]), narrowed(format, triangle[1]), narrowed(format, triangle[2])};
}

std::string to_string(NumberFormat format) {
    struct Named {
        NumberFormat format;
        const char* name;
    };
    static constexpr Named names[] = {{{8, 23}, "fp32"}, {{10, 23}, "fp32e10"}, {{8, 15}, "fp24"},
                                      {{8, 10}, "tf32"}, {{5, 10}, "fp16"},     {{8, 7}, "bf16"}};
    for (const Named& named : names) {
        if (named.format == format) return named.name;
    }
    return fmt::format("e{}m{}", format.exponent_bits, format.mantissa_bits);
}

}  // namespace rtu::model::methods
