#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.hpp"

namespace rtu::model {

/// How much a primitive will add to a mesh.
struct PrimitiveSize {
    std::uint64_t vertex_count = 0;
    std::uint64_t triangle_count = 0;
};

/// A primitive's vertices in the file's order, in its mesh's space, and its triangles as indices into them.
struct PrimitiveGeometry {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
};

/// The size of a primitive once its accessors have been checked against the file's bytes; allocates nothing.
/// Points, lines, and primitives without positions have size 0. Throws Error, which starts with `where`.
[[nodiscard]] PrimitiveSize checked_size(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                         const std::string& where);

/// Reads a primitive, strips and fans turned into index triples with the winding that glTF defines. Throws
/// Error, which starts with `where`, as above and for an index that is not below the vertex count.
[[nodiscard]] PrimitiveGeometry read_primitive(const tinygltf::Model& model,
                                               const tinygltf::Primitive& primitive,
                                               const std::string& where);

}  // namespace rtu::model
