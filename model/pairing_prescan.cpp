#include "model/pairing_prescan.hpp"

#include <array>
#include <bit>

namespace rtu::model {
namespace {

class VertexComparison {
  public:
    VertexComparison(const TriangleMesh& mesh, EdgeIdentity identity)
        : mesh_(mesh), is_by_position_(identity == EdgeIdentity::Position) {}

    [[nodiscard]] bool is_same(std::uint32_t a, std::uint32_t b) const {
        return a == b || (is_by_position_ && bits(a) == bits(b));
    }
    [[nodiscard]] bool share_edge(const Triangle& s, const Triangle& t) const {
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t p = s[i], q = s[(i + 1) % 3];
            if (!is_same(p, q) && is_corner(p, t) && is_corner(q, t)) return true;
        }
        return false;
    }

  private:
    [[nodiscard]] std::array<std::uint32_t, 3> bits(std::uint32_t vertex) const {
        return std::bit_cast<std::array<std::uint32_t, 3>>(mesh_.positions[vertex]);
    }
    [[nodiscard]] bool is_corner(std::uint32_t vertex, const Triangle& t) const {
        return is_same(vertex, t[0]) || is_same(vertex, t[1]) || is_same(vertex, t[2]);
    }

    const TriangleMesh& mesh_;
    bool is_by_position_;
};

}  // namespace

PairingPrescan prescan_pairing(const TriangleMesh& mesh, EdgeIdentity identity) {
    const VertexComparison vertices(mesh, identity);
    const std::uint64_t count = mesh.triangles.size();
    const double most_lone = double(count) * (100.0 - well_paired_percent) / 100.0;
    PairingPrescan scan{true, 0, 0};
    while (scan.scanned_triangles < count) {
        const std::uint64_t t = scan.scanned_triangles;
        const bool is_paired = t + 1 < count && vertices.share_edge(mesh.triangles[t], mesh.triangles[t + 1]);
        scan.scanned_triangles += is_paired ? 2 : 1;
        if (is_paired) continue;
        if (double(++scan.lone_triangles) > most_lone) {
            scan.is_well_paired = false;
            break;
        }
    }
    return scan;
}

}  // namespace rtu::model
