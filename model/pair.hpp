#pragma once

#include <array>
#include <cstdint>

namespace rtu::model {

/// How a triangle of a pair maps to the file's triangle: file corner k is stored corner (rotation + k) % 3,
/// or (rotation - k) mod 3 when `is_reversed`: counted from `rotation` along the stored order, or against it.
struct CornerOrder {
    std::uint8_t rotation = 0;  ///< 0, 1 or 2: the stored corner that is the file's first
    bool is_reversed = false;   ///< the stored winding is the opposite of the file's

    /// The stored corner that is the file's corner 0, 1 or 2.
    [[nodiscard]] constexpr std::uint32_t stored_corner(std::uint32_t file_corner) const {
        return (rotation + (is_reversed ? 3 - file_corner : file_corner)) % 3;
    }
    friend bool operator==(const CornerOrder&, const CornerOrder&) = default;
};

/// Two triangles with a common edge, stored as four vertices, or a lone triangle.
/// Triangle 0 is (v0, v1, v2), triangle 1 is (v0, v2, v3); the common edge is v0-v2.
/// A lone triangle repeats v2 as v3.
struct TrianglePair {
    std::array<std::uint32_t, 4> vertices{};  ///< indices into the mesh's positions
    std::array<std::uint32_t, 2>
        primitive_ids{};  ///< triangle indices in the mesh; [1] = [0] for a lone triangle
    std::array<CornerOrder, 2> corner_order{};
    bool has_second = false;
};

}  // namespace rtu::model
