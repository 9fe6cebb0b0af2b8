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
        Weights<Real> by{edge_function(c, a), edge_function(a, b), edge_function(b, c)};
        const MaskOf<Real> is_doubtful = either(either(by.u == zero, by.v == zero), by.w == zero);
        if (!is_none(is_doubtful)) {
            by.u = select(is_doubtful, edge_function_in_double(c.x, c.y, a.x, a.y), by.u);
            by.v = select(is_doubtful, edge_function_in_double(a.x, a.y, b.x, b.y), by.v);
            by.w = select(is_doubtful, edge_function_in_double(b.x, b.y, c.x, c.y), by.w);
        }
        const MaskOf<Real> is_in = by.agree();
        if (is_none(is_in)) return {is_in};
        return at_depth(ray, interval, is_in, by, a, b, c);
    }
};

}  // namespace rtu::model::methods::RTU_TARGET
RTU_AFTER_TARGET();
