#include "model/methods/target.hpp"

RTU_BEFORE_TARGET();
namespace rtu::model::methods::RTU_TARGET {

/// Woop as published, with its fallback: where an edge function is zero, all three are computed again in
/// binary64, in which products of binary32 numbers are exact. It finds the side of rays that pass a little
/// off an edge; one exactly through it still belongs to both triangles.
struct WoopDouble : Woop {
    static constexpr MethodInfo info{.name = "woop_double",
                                     .title = "Woop, binary64 fallback",
                                     .source = "[WBW13] appendix A",
                                     .stored_bytes = 36,
                                     .axis_owner = AxisOwner::Ray};
    static constexpr bool has_pair = false;

    template <class Real, class AnyAxis>
    [[nodiscard]] static HWY_INLINE Candidate<Real> test(const RayData<Real>& ray,
                                                         const Interval<Real>& interval,
                                                         const Stored<Real>& triangle, AnyAxis axis) {
        const Real zero(0.0F);
        const Sheared<Real> a = shear(ray, triangle.a, axis);
        const Sheared<Real> b = shear(ray, triangle.b, axis);
        const Sheared<Real> c = shear(ray, triangle.c, axis);
        Real of_a = edge_function(b, c), of_b = edge_function(c, a), of_c = edge_function(a, b);
        const MaskOf<Real> is_doubtful = either(either(of_a == zero, of_b == zero), of_c == zero);
        if (!is_none(is_doubtful)) {
            of_a = select(is_doubtful, edge_function_in_double(b.x, b.y, c.x, c.y), of_a);
            of_b = select(is_doubtful, edge_function_in_double(c.x, c.y, a.x, a.y), of_b);
            of_c = select(is_doubtful, edge_function_in_double(a.x, a.y, b.x, b.y), of_c);
        }
        return decide(ray, interval, of_a, of_b, of_c, a, b, c);
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
