#include "model/methods/early_exits.hpp"

#include "model/error.hpp"
#include "model/methods/single_call-inl.hpp"

namespace rtu::model::methods {

EarlyExits count_early_exits(std::span<const Ray> rays, std::span<const Corners> triangles) {
    using namespace RTU_TARGET;
    RTU_CHECK(rays.size() == triangles.size(), "{} rays for {} triangles", rays.size(), triangles.size());
    EarlyExits exits;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto a = vector_of(triangles[i][0]), b = vector_of(triangles[i][1]),
                   c = vector_of(triangles[i][2]);
        const Axis axis = axis_of_triangle(Shevtsov::info, a, b, c);
        const auto ray = Shevtsov::prepare(vector_of(rays[i].origin), vector_of(rays[i].direction), axis);
        const auto stored = Shevtsov::store(a, b, c, axis);
        const auto plane = Shevtsov::test_plane(ray, stored, axis);
        const bool is_near = is_within(Interval<float>{rays[i].t_min, rays[i].t_max},
                                       flip_sign(plane.t_det, plane.det), magnitude(plane.det));
        const bool is_in = Shevtsov::test_aperture(ray, stored, plane, axis).is_hit;
        ++exits.tests;
        exits.by_both += std::uint64_t(!is_near && !is_in);
        exits.by_distance_only += std::uint64_t(!is_near && is_in);
        exits.by_aperture_only += std::uint64_t(is_near && !is_in);
        exits.hits += std::uint64_t(is_near && is_in);
    }
    return exits;
}

}  // namespace rtu::model::methods
