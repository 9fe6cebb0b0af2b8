#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/huge_pages.hpp"
#include "model/mesh.hpp"
#include "model/pair.hpp"

namespace rtu::model {

enum class PairingKind : std::uint8_t {
    None,
    Window,
    EdgeBbsa,
    EdgeBbsaCompressed,
    SaExchange,
    SaSaving,
    Maximum
};

/// The largest N of window:N.
inline constexpr std::uint32_t max_pairing_window = 65536;

/// Every way to write a pairing method, for help and errors; N in [2, max_pairing_window].
inline constexpr std::string_view pairing_method_names =
    "none, window:N, edge_bbsa, edge_bbsa_compressed, sa_exchange, sa_saving or maximum";

/// A pairing method, defined in docs/pairing.md.
struct PairingMethod {
    PairingKind kind = PairingKind::EdgeBbsa;
    std::uint32_t window = 0;  ///< N of window:N, else 0
    friend bool operator==(const PairingMethod&, const PairingMethod&) = default;
};

/// When two triangles' corners are the same vertex: equal index in the file, or bit-equal position.
enum class EdgeIdentity : std::uint8_t { Index, Position };

/// Throws Error for anything that is not a method's name.
[[nodiscard]] PairingMethod parse_pairing_method(std::string_view text);
[[nodiscard]] std::string to_string(PairingMethod method);
/// Throws Error for anything but `position` or `index`.
[[nodiscard]] EdgeIdentity parse_edge_identity(std::string_view text);
[[nodiscard]] std::string_view to_string(EdgeIdentity identity);

/// A partition of a mesh's triangles into pairs and lone triangles.
struct Pairing {
    LargeArray<TrianglePair> pairs;  ///< every triangle exactly once, ordered by their first primitive id
    std::uint64_t pair_count = 0;    ///< entries with two triangles
    std::uint64_t single_count = 0;  ///< entries with one

    /// Share of the triangles that are in a pair, in percent; 0 for an empty mesh.
    [[nodiscard]] double paired_percent() const {
        const double total = 2.0 * double(pair_count) + double(single_count);
        return total > 0 ? 200.0 * double(pair_count) / total : 0.0;
    }
};

/// Pairs the triangles of `mesh`. Deterministic. Pairs store file vertex indices whatever the identity; where
/// the identity is by position, the two triangles' common corners may differ in index but not in position.
/// Sources: window:N, edge_bbsa and edge_bbsa_compressed are [AF] (docs/model.md); all are defined in
/// docs/pairing.md.
[[nodiscard]] Pairing pair_triangles(const TriangleMesh& mesh, PairingMethod method, EdgeIdentity identity);

/// What the 16-byte half-edges of edge_bbsa_compressed cost. Candidates are neighbours of the sorted
/// half-edge table with equal keys, of two different triangles, before the greedy scan.
struct CompressionCost {
    std::uint64_t exact_candidates = 0;  ///< of the uncompressed table
    std::uint64_t candidates = 0;        ///< of the compressed one
    std::uint64_t wrong_candidates = 0;  ///< of the compressed ones, those without a common edge
    std::uint64_t lost_candidates = 0;   ///< exact ones whose triangles are no candidate of the compressed
    std::uint64_t exact_pairs = 0;       ///< of edge_bbsa
    std::uint64_t pairs = 0;             ///< of edge_bbsa_compressed
};

/// Deterministic. Pairs the mesh twice.
[[nodiscard]] CompressionCost compression_cost(const TriangleMesh& mesh, EdgeIdentity identity);

}  // namespace rtu::model
