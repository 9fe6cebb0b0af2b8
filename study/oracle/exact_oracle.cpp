#include "study/oracle/exact_oracle.hpp"

#include <algorithm>

#include "study/oracle/oracle_rational.hpp"
#include "study/oracle/oracle_triangle.hpp"

namespace rtu::study {

namespace {

model::methods::Corners corners_of(const model::TriangleMesh& mesh, const model::Triangle& triangle) {
    return {mesh.positions[triangle[0]], mesh.positions[triangle[1]], mesh.positions[triangle[2]]};
}

bool is_met(const model::Ray& ray, const RationalMeeting& exact) {
    const bool is_on_it = exact.meeting == Meeting::Interior || exact.meeting == Meeting::Edge ||
                          exact.meeting == Meeting::Vertex;
    return is_on_it && is_in_interval(ray, exact.t);
}

}  // namespace

bool ExactHits::allows_closest(std::optional<std::uint32_t> answer) const {
    if (!answer) return !has_interior_hit;
    return std::find(nearest.begin(), nearest.end(), *answer) != nearest.end();
}

bool ExactHits::allows_any(bool answer) const { return answer ? !nearest.empty() : !has_interior_hit; }

ExactHits exact_hits(const model::TriangleMesh& mesh, const model::Ray& ray) {
    ExactHits result;
    std::optional<Rational> least;
    for (std::uint32_t id = 0; id < mesh.triangles.size(); ++id) {
        const model::methods::Corners corners = corners_of(mesh, mesh.triangles[id]);
        if (is_surely_missed(ray, corners)) continue;
        const RationalMeeting exact = meet_exactly(ray, corners);
        if (!is_met(ray, exact)) continue;
        result.has_interior_hit |= exact.meeting == Meeting::Interior;
        if (!least || exact.t < *least) {
            least = exact.t;
            result.nearest.clear();
        }
        if (exact.t == *least) result.nearest.push_back(id);
    }
    return result;
}

}  // namespace rtu::study
