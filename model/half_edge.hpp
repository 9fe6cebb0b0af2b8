#pragma once

#include <compare>
#include <cstdint>

namespace rtu::model {

/// One side of one triangle: side s of triangle t joins its corners s and (s + 1) % 3 and is half-edge 3 t +
/// s.
struct HalfEdge {
    std::uint32_t index = 0;

    [[nodiscard]] constexpr std::uint32_t triangle() const { return index / 3; }
    [[nodiscard]] constexpr std::uint32_t side() const { return index % 3; }
    friend constexpr auto operator<=>(const HalfEdge&, const HalfEdge&) = default;
};

}  // namespace rtu::model
