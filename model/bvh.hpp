#pragma once

#include <cstdint>

#include "model/memory_image.hpp"
#include "model/mesh.hpp"
#include "model/pairing.hpp"

namespace rtu::model {

/// How a node's pairs are divided among its children.
enum class SplitKind : std::uint8_t {
    Object,   ///< each pair goes to one child: it is in one leaf
    Spatial,  ///< or a plane divides them, and a pair that it cuts goes to both sides: it may be in many
              ///< leaves
};

/// How Embree chooses a node's children.
enum class BvhBuilder : std::uint8_t {
    Sah,     ///< by the surface area heuristic, over bins of the pairs' centres: its medium quality
    Morton,  ///< by the next bit in which the pairs' places along a Z-shaped curve differ: its low quality
};

/// Shape of the tree.
struct BvhOptions {
    std::uint32_t width = 4;           ///< children a node: 2, 4, 6 or 8
    std::uint32_t max_leaf_pairs = 1;  ///< pairs a leaf, 1..8; spatial splits: 1
    NodeFormat node_format = NodeFormat::Full;
    SplitKind splits = SplitKind::Object;
    std::uint32_t split_budget_percent = 20;  ///< leaves that spatial splits may add, in % of the pairs
    BvhBuilder builder = BvhBuilder::Sah;     ///< spatial splits: Sah, with which they are its high quality
};

/// Builds a BVH over the pairs with one of Embree's builders, with or without spatial splits, and lays it out
/// as memory_image.hpp says: a pair that several leaves refer to is stored once. Byte-identical on every
/// machine: the builder runs on one thread. Throws Error for no pairs or an image beyond the 16 GiB that a
/// NodeRef can address.
[[nodiscard]] MemoryImage build_bvh(const TriangleMesh& mesh, const Pairing& pairing, BvhOptions options);

/// Checks the image against the mesh; of quantised nodes the exact ones, and that each is what quantise()
/// makes of its exact one and encloses it: every inner node's box is that of its children (bit-exact, no
/// slack), every triangle is in the image once with its file corners in its file order, every reference
/// points into the image. A pair that one leaf refers to has the box of its vertices there; one that several
/// refer to is covered by their boxes (see check_coverage()), of which none is larger than the pair's. Throws
/// std::logic_error naming the first address that is wrong.
void validate(const MemoryImage& image, const TriangleMesh& mesh);

}  // namespace rtu::model
