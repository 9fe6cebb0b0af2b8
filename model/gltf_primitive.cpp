#include "model/gltf_primitive.hpp"

#include <numeric>
#include <optional>

#include "model/error.hpp"
#include "model/gltf_accessor.hpp"

namespace rtu::model {

namespace {

/// The accessor of the positions, or nothing for a primitive that adds no triangles.
std::optional<int> position_accessor(const tinygltf::Primitive& primitive, const std::string& where) {
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        throw Error("{}: expected a mode from 0 to 6, found {}", where, primitive.mode);
    }
    const auto found = primitive.attributes.find("POSITION");
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || found == primitive.attributes.end()) {
        return std::nullopt;
    }
    return found->second;
}

std::uint64_t triangle_count(int mode, std::uint64_t corner_count, const std::string& where) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        if (corner_count % 3 != 0) {
            throw Error("{}: expected a multiple of 3 corners, found {}", where, corner_count);
        }
        return corner_count / 3;
    }
    if (corner_count == 1 || corner_count == 2) {
        throw Error("{}: expected at least 3 corners in a strip or fan, found {}", where, corner_count);
    }
    return corner_count == 0 ? 0 : corner_count - 2;
}

/// The corners of triangle i of a primitive, as positions in its list of corners (glTF 2.0, section 3.7.2.1).
Triangle corners(int mode, std::uint32_t i) {
    switch (mode) {
        case TINYGLTF_MODE_TRIANGLE_STRIP:
            return {i, i + 1 + i % 2, i + 2 - i % 2};
        case TINYGLTF_MODE_TRIANGLE_FAN:
            return {i + 1, i + 2, 0};
        default:
            return {3 * i, 3 * i + 1, 3 * i + 2};
    }
}

std::vector<std::uint32_t> corner_list(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                       std::size_t vertex_count, const std::string& where) {
    if (primitive.indices < 0) {
        std::vector<std::uint32_t> list(vertex_count);
        std::iota(list.begin(), list.end(), 0U);
        return list;
    }
    std::vector<std::uint32_t> list = read_indices(model, primitive.indices, where);
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list[i] >= vertex_count) {
            throw Error("{}: index {} is {}, expected below {}, the number of vertices", where, i, list[i],
                        vertex_count);
        }
    }
    return list;
}

}  // namespace

PrimitiveSize checked_size(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           const std::string& where) {
    const std::optional<int> positions = position_accessor(primitive, where);
    if (!positions) {
        return {};
    }
    const std::uint64_t vertex_count = checked_count(model, *positions, AccessorUse::Positions, where);
    const std::uint64_t corner_count =
        primitive.indices < 0 ? vertex_count
                              : checked_count(model, primitive.indices, AccessorUse::Indices, where);
    return {vertex_count, triangle_count(primitive.mode, corner_count, where)};
}

PrimitiveGeometry read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                 const std::string& where) {
    const std::optional<int> positions = position_accessor(primitive, where);
    PrimitiveGeometry geometry;
    if (!positions) {
        return geometry;
    }
    geometry.positions = read_positions(model, *positions, where);
    const std::vector<std::uint32_t> list = corner_list(model, primitive, geometry.positions.size(), where);
    geometry.triangles.resize(triangle_count(primitive.mode, list.size(), where));
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        const Triangle at = corners(primitive.mode, i);
        geometry.triangles[i] = {list[at[0]], list[at[1]], list[at[2]]};
    }
    return geometry;
}

}  // namespace rtu::model
