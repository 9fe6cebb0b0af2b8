#include "model/pairing.hpp"

#include <limits>
#include <numeric>
#include <span>

#include "model/edge_bbsa.hpp"
#include "model/edge_bbsa_compressed.hpp"
#include "model/edge_table.hpp"
#include "model/error.hpp"
#include "model/matching.hpp"
#include "model/maximum_matching.hpp"
#include "model/pair_layout.hpp"
#include "model/pair_saving.hpp"
#include "model/sa_exchange.hpp"
#include "model/weld.hpp"
#include "model/window_pairing.hpp"

namespace rtu::model {
namespace {

/// Room for everything that a method takes from the scratch memory.
std::size_t scratch_bytes(const TriangleMesh& mesh) {
    constexpr std::size_t a_triangle =
        3 * (sizeof(BucketedHalfEdge) + 2 * sizeof(PairCandidate)) + sizeof(HalfEdge);
    constexpr std::size_t a_vertex = 6 * sizeof(std::uint32_t);  // up to 4 slots of the hash table
    constexpr std::size_t rounding = 1024;
    return mesh.triangles.size() * a_triangle + mesh.positions.size() * a_vertex + rounding;
}

std::span<std::uint32_t> vertex_ids(const TriangleMesh& mesh, EdgeIdentity identity, ScratchMemory& memory) {
    if (identity == EdgeIdentity::Position) return weld_positions(mesh.positions, memory);
    const auto ids = memory.take<std::uint32_t>(mesh.positions.size());
    std::iota(ids.begin(), ids.end(), 0U);
    return ids;
}

Matching match(const IdentifiedMesh& mesh, PairingMethod method, ScratchMemory& memory) {
    const auto triangle_count = std::uint32_t(mesh.triangles.size());
    switch (method.kind) {
        case PairingKind::None:
            return Matching(triangle_count, memory);
        case PairingKind::Window:
            return match_in_window(mesh, method.window, memory);
        case PairingKind::EdgeBbsa:
            return match_greedily(edge_bbsa_candidates(mesh, memory), triangle_count, memory);
        case PairingKind::EdgeBbsaCompressed:
            return match_compressed(mesh, memory);
        case PairingKind::SaExchange:
            return match_with_exchanges(mesh, memory);
        case PairingKind::SaSaving:
            return match_by_saving(mesh, memory);
        case PairingKind::Maximum:
            return match_maximum(mesh, memory);
    }
    fail_check(__FILE__, __LINE__, "unknown pairing kind");
}

Pairing collect(const IdentifiedMesh& mesh, const Matching& matching) {
    Pairing result;
    result.pair_count = matching.pair_count();
    result.single_count = mesh.triangles.size() - 2 * result.pair_count;
    result.pairs.reserve(result.pair_count + result.single_count);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (matching.is_free(t)) {
            result.pairs.push_back(make_lone(mesh, t));
        } else if (const HalfEdge second = matching.partner(t); second.triangle() > t) {
            const HalfEdge first = matching.partner(second.triangle());
            result.pairs.push_back(make_pair(mesh, first, second));
        }
    }
    return result;
}

}  // namespace

Pairing pair_triangles(const TriangleMesh& mesh, PairingMethod method, EdgeIdentity identity) {
    constexpr std::size_t index_end = std::numeric_limits<std::uint32_t>::max();
    RTU_CHECK(mesh.triangles.size() <= index_end / 3, "{} triangles", mesh.triangles.size());
    RTU_CHECK(mesh.positions.size() < index_end, "{} vertices", mesh.positions.size());
    ScratchMemory memory(scratch_bytes(mesh));
    const IdentifiedMesh identified{mesh.triangles, mesh.positions, vertex_ids(mesh, identity, memory)};
    return collect(identified, match(identified, method, memory));
}

}  // namespace rtu::model
