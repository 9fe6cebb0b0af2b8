#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "model/methods/method.hpp"
#include "model/ray.hpp"

namespace rtu::study {

/// How a ray's line meets a triangle, edges and corners included.
enum class Meeting : std::uint8_t {
    Miss,
    Interior,
    Edge,
    Vertex,
    EdgeOn,     ///< the line lies in the triangle's plane, and need not pass over it: never a hit
    Degenerate  ///< it touches the line or point that is all of the triangle: never a hit
};

/// The least number whose nearest binary32 is infinity: half a unit beyond the largest.
inline constexpr double first_to_round_to_infinity = 0x1.ffffffp127;

template <class Number>
using NumberVector = std::array<Number, 3>;

/// A line and a triangle in numbers of which +, -, * and comparisons are exact, and what follows from their
/// signs. The axis is that of the direction's largest component.
template <class Number>
class ExactMeeting {
  public:
    using Vector = NumberVector<Number>;

    ExactMeeting(const Vector& origin, const Vector& direction, const std::array<Vector, 3>& corners,
                 std::size_t axis)
        : direction_(direction), corners_(corners), axis_(axis) {
        const Vector a = minus(corners[0], origin), b = minus(corners[1], origin),
                     c = minus(corners[2], origin);
        const Vector ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
        weights_ = {dot(direction, bc), dot(direction, ca), dot(direction, ab)};
        along_ = weights_[0] + weights_[1] + weights_[2];
        before_ = dot(c, ab);
        has_area_ = ab[0] + bc[0] + ca[0] != 0 || ab[1] + bc[1] + ca[1] != 0 || ab[2] + bc[2] + ca[2] != 0;
    }

    /// Volume that the direction spans with the edge opposite to a corner. The corner's barycentric weight is
    /// this by `along`.
    [[nodiscard]] const Number& weight(std::size_t corner) const { return weights_[corner]; }
    /// direction . n with n = (b - a) x (c - a).
    [[nodiscard]] const Number& along() const { return along_; }
    /// (a - origin) . n; t is this by `along`.
    [[nodiscard]] const Number& before() const { return before_; }

    [[nodiscard]] Meeting meeting() const {
        int zeros = 0, positive = 0;
        for (const Number& weight : weights_) {
            zeros += weight == 0 ? 1 : 0;
            positive += weight > 0 ? 1 : 0;
        }
        if (positive != 0 && zeros + positive != 3) return Meeting::Miss;
        if (zeros == 3) return has_area_ ? Meeting::EdgeOn : Meeting::Degenerate;
        return zeros == 0 ? Meeting::Interior : zeros == 1 ? Meeting::Edge : Meeting::Vertex;
    }

    /// Of an Edge meeting the edge i, from corner i to the next; of a Vertex meeting the corner; else 0.
    [[nodiscard]] std::uint8_t feature() const {
        const Meeting kind = meeting();
        if (kind != Meeting::Edge && kind != Meeting::Vertex) return 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if ((weights_[i] == 0) == (kind == Meeting::Edge)) {
                return std::uint8_t(kind == Meeting::Edge ? (i + 1) % 3 : i);
            }
        }
        return 0;
    }

    /// Whether the line, moved by (e, e^2) along the two axes that follow its own, e infinitely small and
    /// positive, pierces the triangle: true for exactly one triangle of a closed surface where the line
    /// crosses an edge or a vertex of it (docs/model.md, pair test).
    [[nodiscard]] bool is_owner() const {
        if (along_ == 0) return false;
        const int first = side(0);
        return first != 0 && first == side(1) && first == side(2);
    }

  private:
    static Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
    static Vector cross(const Vector& a, const Vector& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static Number dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
    static int sign(const Number& x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

    // The weight is a polynomial in e when the line moves; its first coefficient that is not zero decides.
    [[nodiscard]] int side(std::size_t corner) const {
        if (weights_[corner] != 0) return sign(weights_[corner]);
        const Vector& p = corners_[(corner + 1) % 3];
        const Vector& q = corners_[(corner + 2) % 3];
        const std::size_t x = (axis_ + 1) % 3, y = (axis_ + 2) % 3, z = axis_;
        const int by_e = sign(direction_[z] * (p[y] - q[y]) - direction_[y] * (p[z] - q[z]));
        return by_e != 0 ? by_e : sign(direction_[z] * (q[x] - p[x]) - direction_[x] * (q[z] - p[z]));
    }

    Vector direction_;
    std::array<Vector, 3> corners_;
    std::size_t axis_;
    std::array<Number, 3> weights_;
    Number along_, before_;
    bool has_area_;
};

/// The axis of a direction's largest component; x before y before z where they are equal.
[[nodiscard]] inline std::size_t largest_axis(model::Vec3 d) {
    const auto size = [&d](std::size_t axis) { return d[axis] < 0 ? -d[axis] : d[axis]; };
    return size(0) >= size(1) && size(0) >= size(2) ? 0 : size(1) >= size(2) ? 1 : 2;
}

}  // namespace rtu::study
