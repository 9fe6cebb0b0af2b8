#pragma once

#include <cstdint>

#include "model/memory_image.hpp"
#include "model/mesh.hpp"
#include "model/pairing.hpp"

namespace rtu::model {

/// Shape of the tree.
struct BvhOptions {
    std::uint32_t width = 4;           ///< children a node: 2, 4, 6 or 8
    std::uint32_t max_leaf_pairs = 1;  ///< pairs a leaf, 1..8
    NodeFormat node_format = NodeFormat::Full;
};

/// Builds a BVH over the pairs' boxes with Embree's binned SAH builder and lays it out as memory_image.hpp
/// says. Byte-identical on every machine: the builder runs on one thread. Throws Error for no pairs or an
/// image beyond the 16 GiB that a NodeRef can address.
[[nodiscard]] MemoryImage build_bvh(const TriangleMesh& mesh, const Pairing& pairing, BvhOptions options);

/// Checks the image against the mesh; of quantised nodes the exact ones, and that each is what quantise()
/// makes of its exact one and encloses it: every child box lies in its parent's box (bit-exact, no slack),
/// every leaf's box holds its pairs' vertices, every triangle is in exactly one leaf with its file corners in
/// its file order, every reference points into the image. Throws std::logic_error naming the first address
/// that is wrong.
void validate(const MemoryImage& image, const TriangleMesh& mesh);

}  // namespace rtu::model
