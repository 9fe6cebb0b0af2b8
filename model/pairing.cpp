#include "model/pairing.hpp"

#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "model/blocks.hpp"
#include "model/edge_bbsa.hpp"
#include "model/edge_bbsa_compressed.hpp"
#include "model/error.hpp"
#include "model/half_edge.hpp"
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
    constexpr std::size_t half_edge_record = 16;  // the largest, of edge_bbsa_compressed; two tables of them
    constexpr std::size_t a_triangle = 6 * half_edge_record + sizeof(HalfEdge);
    constexpr std::size_t a_vertex = sizeof(std::uint32_t) + 16;  // its identity and its record in welding
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
            return match_by_edge_area(mesh, EdgeRings(mesh, memory), memory);
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

TrianglePair entry_of(const IdentifiedMesh& mesh, const Matching& matching, std::uint32_t t) {
    const HalfEdge second = matching.partner(t);
    if (second.triangle() == t) return make_lone(mesh, t);
    return make_pair(mesh, matching.partner(second.triangle()), second);
}

bool is_first(const Matching& matching, std::uint32_t t) { return matching.partner(t).triangle() >= t; }

Pairing collect(const IdentifiedMesh& mesh, const Matching& matching) {
    Pairing result;
    result.pair_count = matching.pair_count();
    result.single_count = mesh.triangles.size() - 2 * result.pair_count;
    result.pairs.resize(result.pair_count + result.single_count);
    const Blocks blocks = Blocks::of_items(mesh.triangles.size());
    std::vector<std::size_t> places(blocks.count());  // counts, then where a block's entries begin
    blocks.for_each([&](std::size_t block, std::size_t begin, std::size_t end) {
        std::size_t count = 0;
        for (auto t = std::uint32_t(begin); t < end; ++t) count += std::size_t{is_first(matching, t)};
        places[block] = count;
    });
    std::exclusive_scan(places.begin(), places.end(), places.begin(), std::size_t{0});
    blocks.for_each([&](std::size_t block, std::size_t begin, std::size_t end) {
        // A list first: whether a triangle is the first of its pair is hard to predict.
        std::vector<std::uint32_t> firsts(end - begin);
        std::size_t count = 0;
        for (auto t = std::uint32_t(begin); t < end; ++t) {
            firsts[count] = t;
            count += std::size_t{is_first(matching, t)};
        }
        TrianglePair* next = result.pairs.data() + places[block];
        for (const std::uint32_t t : std::span(firsts).first(count)) *next++ = entry_of(mesh, matching, t);
    });
    return result;
}

void check_size(const TriangleMesh& mesh) {
    constexpr std::size_t index_end = std::numeric_limits<std::uint32_t>::max();
    RTU_CHECK(mesh.triangles.size() <= index_end / 3, "{} triangles", mesh.triangles.size());
    RTU_CHECK(mesh.positions.size() < index_end, "{} vertices", mesh.positions.size());
}

/// A mesh whose vertices are identified, with the memory of everything that is computed from it.
struct Workspace {
    ScratchMemory memory;
    IdentifiedMesh mesh;

    Workspace(const TriangleMesh& source, EdgeIdentity identity)
        : memory(scratch_bytes(source)),
          mesh{source.triangles, source.positions, vertex_ids(source, identity, memory)} {}
};

}  // namespace

Pairing pair_triangles(const TriangleMesh& mesh, PairingMethod method, EdgeIdentity identity) {
    check_size(mesh);
    Workspace workspace(mesh, identity);
    return collect(workspace.mesh, match(workspace.mesh, method, workspace.memory));
}

CompressionCost compression_cost(const TriangleMesh& mesh, EdgeIdentity identity) {
    check_size(mesh);
    Workspace workspace(mesh, identity);
    CompressionCost cost = compression_cost(workspace.mesh, workspace.memory);
    const auto pair_count = [&](PairingKind kind) {
        const ScratchMemory::Scope scope(workspace.memory);
        return match(workspace.mesh, {kind, 0}, workspace.memory).pair_count();
    };
    cost.exact_pairs = pair_count(PairingKind::EdgeBbsa);
    cost.pairs = pair_count(PairingKind::EdgeBbsaCompressed);
    return cost;
}

}  // namespace rtu::model
