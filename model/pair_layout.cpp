#include "model/pair_layout.hpp"

#include "model/error.hpp"

namespace rtu::model {

TrianglePair make_lone(const IdentifiedMesh& mesh, std::uint32_t triangle) {
    const Triangle& t = mesh.triangles[triangle];
    return {{t[0], t[1], t[2], t[2]}, {triangle, triangle}, {}, false};
}

TrianglePair make_pair(const IdentifiedMesh& mesh, HalfEdge first, HalfEdge second) {
    const std::uint32_t t0 = first.triangle(), s0 = first.side();
    const std::uint32_t t1 = second.triangle(), s1 = second.side();
    const Triangle &file0 = mesh.triangles[t0], &file1 = mesh.triangles[t1];
    // The common edge runs v2 -> v0 in triangle 0, so (v0, v1, v2) is a rotation of the file's order.
    const std::uint32_t v0 = file0[(s0 + 1) % 3], v1 = file0[(s0 + 2) % 3], v2 = file0[s0];
    const std::uint32_t begin = file1[s1], end = file1[(s1 + 1) % 3], v3 = file1[(s1 + 2) % 3];
    const auto is_same = [&mesh](std::uint32_t a, std::uint32_t b) {
        return mesh.vertex_ids[a] == mesh.vertex_ids[b];
    };
    // In triangle 1 it runs v0 -> v2 where the windings agree.
    const bool is_reversed = !is_same(begin, v0);
    RTU_CHECK(t0 != t1 && !is_same(v0, v2) && is_same(is_reversed ? end : begin, v0) &&
                  is_same(is_reversed ? begin : end, v2),
              "triangles {} and {} have no common edge on their sides {} and {}", t0, t1, s0, s1);
    const CornerOrder order0{std::uint8_t((5 - s0) % 3), false};
    const CornerOrder order1{std::uint8_t((is_reversed ? s1 + 1 : 3 - s1) % 3), is_reversed};
    return {{v0, v1, v2, v3}, {t0, t1}, {order0, order1}, true};
}

Triangle file_corners(const TrianglePair& pair, std::uint32_t which) {
    const auto& v = pair.vertices;
    const Triangle stored =
        which == 0 || !pair.has_second ? Triangle{v[0], v[1], v[2]} : Triangle{v[0], v[2], v[3]};
    const CornerOrder order = pair.corner_order[pair.has_second ? which : 0];
    return {stored[order.stored_corner(0)], stored[order.stored_corner(1)], stored[order.stored_corner(2)]};
}

}  // namespace rtu::model
