#pragma once

// The byte-exact memory image: what the machine's memory holds, and what traversal reads. Little-endian.
//
//   address 0                    nodes, in depth-first order (a node, then the subtrees of its children in
//                                child order); the root is the node at address 0
//   node_count * node_bytes      leaves, 64 bytes a pair, in the order in which the same walk first meets
//   them;
//                                with spatial splits several nodes may refer to one leaf
//
// Inner node of a W-wide tree (binary32 structure of arrays; 64, 128, 192, 256 bytes for W = 2, 4, 6, 8):
//   float  lo_x[W], lo_y[W], lo_z[W], hi_x[W], hi_y[W], hi_z[W]   child boxes; unused: lo = +inf, hi = -inf
//   uint32 child[W]                                               NodeRef; unused: 0
//   uint32 child_count                                            1..W, the used children come first
//   zero padding to a multiple of 64
// NodeRef:  bit 31     1 = leaf
//           bits 30-28 leaf: number of pairs - 1; inner node: 0
//           bits 27-0  address / 64
// Pair of a leaf (64 bytes); triangle 0 = (v0, v1, v2), triangle 1 = (v0, v2, v3):
//   float  v0[3], v1[3], v2[3], v3[3]   lone triangle: v3 = v2
//   uint32 primitive_ids[2]             lone triangle: the same twice
//   uint32 flags                        bit 0: has triangle 1
//                                       bits 1-2, 3: rotation and reversal of triangle 0
//                                       bits 4-5, 6: of triangle 1
//                                       bits 8, 9: triangle 0, 1 is degenerate
//   uint32 zero

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "model/aabb.hpp"
#include "model/pair.hpp"

namespace rtu::model {

inline constexpr std::uint32_t image_block_bytes = 64;
inline constexpr std::uint32_t max_bvh_width = 8;
inline constexpr std::uint32_t max_leaf_pairs = 8;
/// What a NodeRef can address.
inline constexpr std::uint64_t max_image_bytes = std::uint64_t(image_block_bytes) << 28;

/// Where a child lies in the image, and what it is; 4 bytes, as stored in nodes.
class NodeRef {
  public:
    NodeRef() = default;
    [[nodiscard]] static NodeRef inner(std::uint64_t address) {
        return NodeRef(std::uint32_t(address / image_block_bytes));
    }
    [[nodiscard]] static NodeRef leaf(std::uint64_t address, std::uint32_t pair_count) {
        return NodeRef(0x8000'0000U | (pair_count - 1) << 28 | std::uint32_t(address / image_block_bytes));
    }
    [[nodiscard]] bool is_leaf() const { return (bits_ & 0x8000'0000U) != 0; }
    [[nodiscard]] std::uint64_t address() const {
        return std::uint64_t(bits_ & 0x0fff'ffffU) * image_block_bytes;
    }
    /// Pairs in the leaf, 1..8; 1 for an inner node.
    [[nodiscard]] std::uint32_t pair_count() const { return ((bits_ >> 28) & 7U) + 1; }
    friend bool operator==(NodeRef, NodeRef) = default;

  private:
    explicit NodeRef(std::uint32_t bits) : bits_(bits) {}
    std::uint32_t bits_ = 0;
};

/// An inner node exactly as it lies in the image.
template <std::uint32_t Width>
struct alignas(image_block_bytes) Node {
    std::array<std::array<std::array<float, Width>, 3>, 2> planes;  ///< [0: lo, 1: hi][axis][child]
    std::array<NodeRef, Width> child;
    std::uint32_t child_count;

    [[nodiscard]] Aabb box(std::size_t i) const {
        return {{planes[0][0][i], planes[0][1][i], planes[0][2][i]},
                {planes[1][0][i], planes[1][1][i], planes[1][2][i]}};
    }
    void set_box(std::size_t i, const Aabb& box) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            planes[0][axis][i] = box.lo[axis];
            planes[1][axis][i] = box.hi[axis];
        }
    }
};
static_assert(sizeof(Node<2>) == 64 && sizeof(Node<4>) == 128 && sizeof(Node<6>) == 192 &&
              sizeof(Node<8>) == 256);

/// A pair exactly as it lies in the image.
struct alignas(image_block_bytes) LeafPair {
    std::array<Vec3, 4> vertices;
    std::array<std::uint32_t, 2> primitive_ids;
    std::uint32_t flags;
    std::uint32_t reserved;

    [[nodiscard]] bool has_second() const { return (flags & 1U) != 0; }
    [[nodiscard]] CornerOrder corner_order(std::uint32_t triangle) const {
        const std::uint32_t bits = flags >> (1 + 3 * triangle);
        return {std::uint8_t(bits & 3U), (bits & 4U) != 0};
    }
    /// A degenerate triangle (exactly zero area) is stored but never hit.
    [[nodiscard]] bool is_degenerate(std::uint32_t triangle) const {
        return (flags >> (8 + triangle) & 1U) != 0;
    }
};
static_assert(sizeof(LeafPair) == image_block_bytes);

/// One pair as the machine stores it.
[[nodiscard]] LeafPair make_leaf_pair(const TrianglePair& pair, std::span<const Vec3> positions);

/// The BVH and its leaves as bytes. `width` is 2, 4, 6 or 8.
struct MemoryImage {
    struct alignas(image_block_bytes) Block {
        std::array<std::byte, image_block_bytes> bytes;
    };
    std::vector<Block> blocks;
    Aabb bounds;  ///< of the whole scene
    std::uint32_t width = 4;
    std::uint32_t depth = 0;  ///< inner nodes on the longest path from the root
    std::uint64_t node_count = 0;
    std::uint64_t leaf_count = 0;       ///< children of nodes that are leaves
    std::uint64_t pair_count = 0;       ///< pairs and lone triangles that are stored
    std::uint64_t reference_count = 0;  ///< pairs of all leaves; more than `pair_count` after spatial splits

    [[nodiscard]] static std::uint64_t node_bytes(std::uint32_t width) {
        return (std::uint64_t(width) * 28 + 4 + 63) / 64 * 64;
    }
    /// Whether a ray may come to one pair twice.
    [[nodiscard]] bool has_shared_pairs() const { return reference_count > pair_count; }
    [[nodiscard]] std::uint64_t size_bytes() const { return blocks.size() * image_block_bytes; }
    [[nodiscard]] NodeRef root() const { return NodeRef::inner(0); }
    template <std::uint32_t Width>
    [[nodiscard]] const Node<Width>& node(NodeRef ref) const {
        return *reinterpret_cast<const Node<Width>*>(&blocks[ref.address() / image_block_bytes]);
    }
    [[nodiscard]] const LeafPair& leaf_pair(NodeRef ref, std::uint32_t index) const {
        return *reinterpret_cast<const LeafPair*>(&blocks[ref.address() / image_block_bytes + index]);
    }
};

}  // namespace rtu::model
