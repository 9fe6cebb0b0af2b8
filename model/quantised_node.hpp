#pragma once

// The quantised inner node: child boxes as 8-bit steps on a grid of the node, after [YKL17]. Little-endian.
//
//   float  origin[3]           where the grid begins: the least corner of the child boxes
//   uint8  exponent[3]         of the grid's step on each axis, biased as in binary32: step = 2^(e -
//   127), 1..254 uint8  child_count         1..W, the used children come first uint8  lo_x[W], lo_y[W],
//   lo_z[W], hi_x[W], hi_y[W], hi_z[W]   in steps; unused: lo = 255, hi = 0 uint32 first_node address / 64 of
//   the first child that is an inner node; without any: 0 uint32 first_leaf          address / 64 of the
//   first child that is a leaf; without any: 0 uint4  kinds[W]            low half of a byte first; bit 3: a
//   leaf, bits 2-0: its pairs - 1; inner node: 0 zero padding to a multiple of 64: 64, 64, 64, 128 bytes for
//   W = 2, 4, 6, 8
//
// A child's references are not stored: a node's inner children lie side by side, in child order, and so do
// its leaves. A plane is origin + q * step in binary32. The product is exact (or infinite), so what rounds is
// one addition, and a plane never decreases with q.
//
// [YKL17] has the same grid, and 8-wide nodes of 80 bytes; here addresses are multiples of 64. It folds the
// grid into the ray, here the planes are made first: so a quantised box encloses the box it stands for, bit
// for bit, and every rounded value of its slab test is on the safe side of the other's.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "model/memory_image.hpp"

namespace rtu::model {

/// A quantised inner node exactly as it lies in the image.
template <std::uint32_t Width>
struct alignas(image_block_bytes) QuantisedNode {
    static constexpr std::uint32_t width = Width;
    static constexpr NodeFormat format = NodeFormat::Quantised;

    std::array<float, 3> origin;
    std::array<std::uint8_t, 3> exponent;
    std::uint8_t child_count;
    std::array<std::array<std::array<std::uint8_t, Width>, 3>, 2> planes;  ///< [0: lo, 1: hi][axis][child]
    std::uint32_t first_node;
    std::uint32_t first_leaf;
    std::array<std::uint8_t, Width / 2> kinds;

    /// The grid's step on `axis`.
    [[nodiscard]] float step(std::size_t axis) const {
        return std::bit_cast<float>(std::uint32_t(exponent[axis]) << 23);
    }
    /// Where `steps` steps on `axis` lead to.
    [[nodiscard]] float plane(std::size_t axis, std::uint32_t steps) const {
        return origin[axis] + float(steps) * step(axis);
    }
    [[nodiscard]] Aabb box(std::size_t i) const {
        Aabb box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.lo[axis] = plane(axis, planes[0][axis][i]);
            box.hi[axis] = plane(axis, planes[1][axis][i]);
        }
        return box;
    }
    /// Requires i < child_count.
    [[nodiscard]] NodeRef child(std::size_t i) const {
        std::uint64_t node = first_node, leaf = first_leaf;
        for (std::size_t before = 0; before < i; ++before) {
            if (is_leaf(before)) {
                leaf += pair_count(before);
            } else {
                node += sizeof(QuantisedNode) / image_block_bytes;
            }
        }
        return is_leaf(i) ? NodeRef::leaf(leaf * image_block_bytes, pair_count(i))
                          : NodeRef::inner(node * image_block_bytes);
    }

  private:
    [[nodiscard]] std::uint32_t kind(std::size_t i) const { return kinds[i / 2] >> (i % 2 * 4) & 15U; }
    [[nodiscard]] bool is_leaf(std::size_t i) const { return (kind(i) & 8U) != 0; }
    [[nodiscard]] std::uint32_t pair_count(std::size_t i) const { return (kind(i) & 7U) + 1; }
};
static_assert(sizeof(QuantisedNode<2>) == 64 && sizeof(QuantisedNode<4>) == 64 &&
              sizeof(QuantisedNode<6>) == 64 && sizeof(QuantisedNode<8>) == 128);

/// The node that stands for `node`: its grid is the finest that reaches all boxes, each box the smallest on
/// the grid that encloses the child's. Coordinates must be finite. A plane may become infinite where the
/// boxes reach over more than half of binary32's range. References become kinds; first_node and first_leaf
/// are those of the first such child.
template <std::uint32_t Width>
[[nodiscard]] QuantisedNode<Width> quantise(const Node<Width>& node);

/// The same tree with quantised nodes: same children in the same order, same leaves. An inner node's inner
/// children lie side by side, then the subtree of each; leaves in the order of that walk, those of a node
/// side by side. The boxes that the quantised ones stand for are in `exact_nodes`.
[[nodiscard]] MemoryImage quantise_nodes(const MemoryImage& full);

}  // namespace rtu::model
