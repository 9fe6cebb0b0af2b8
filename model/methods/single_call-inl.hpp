// A method's templates at Real = float behind one call.

#include <optional>
#include <vector>

#include "model/methods/methods-inl.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

[[nodiscard]] inline Vector<float> vector_of(Vec3 v) { return {{v.x, v.y, v.z}}; }

/// The axis that a method's arithmetic depends on, of this ray or triangle; 0 when it depends on none.
template <class Real>
[[nodiscard]] Axis axis_of_triangle(const MethodInfo& info, const Vector<Real>& a, const Vector<Real>& b,
                                    const Vector<Real>& c) {
    return info.axis_owner == AxisOwner::Triangle ? largest_axis(cross(b - a, c - a)) : Axis{};
}
template <class Real>
[[nodiscard]] Axis axis_of_ray(const MethodInfo& info, const Vector<Real>& direction) {
    return info.axis_owner == AxisOwner::Ray ? largest_axis(direction) : Axis{};
}

template <class M>
[[nodiscard]] std::optional<TestHit> test_once(const Ray& ray, const Corners& triangle) {
    const Vector<float> a = vector_of(triangle[0]), b = vector_of(triangle[1]), c = vector_of(triangle[2]);
    const Vector<float> direction = vector_of(ray.direction);
    const Axis of_ray = axis_of_ray(M::info, direction), of_triangle = axis_of_triangle(M::info, a, b, c);
    const auto kept = M::prepare(vector_of(ray.origin), direction, of_ray);
    const auto stored = M::store(a, b, c, of_triangle);
    const Axis axis = M::info.axis_owner == AxisOwner::Ray ? of_ray : of_triangle;
    const Candidate<float> candidate = M::test(kept, Interval<float>{ray.t_min, ray.t_max}, stored, axis);
    if (!candidate.is_hit) return std::nullopt;
    const Distances<float> hit = M::finish(candidate);
    return TestHit{hit.t, hit.u, hit.v};
}

template <class... Methods>
[[nodiscard]] std::vector<Method> calls_of(MethodList<Methods...>) {
    return {Method{Methods::info, &test_once<Methods>}...};
}

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
