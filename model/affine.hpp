#pragma once

#include <array>
#include <cstddef>

#include "model/vec3.hpp"

namespace rtu::model {

/// An affine map in double precision: row `r` gives coordinate r of the image, column 3 is the translation.
struct Affine {
    std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

    friend bool operator==(const Affine&, const Affine&) = default;
};

/// The map that applies `inner` first, then `outer`.
[[nodiscard]] constexpr Affine operator*(const Affine& outer, const Affine& inner) {
    Affine product;
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 4; ++c) {
            double sum = c == 3 ? outer.rows[r][3] : 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                sum += outer.rows[r][k] * inner.rows[k][c];
            }
            product.rows[r][c] = sum;
        }
    }
    return product;
}

/// The image of `p`, rounded once.
[[nodiscard]] constexpr Vec3 transform(const Affine& map, Vec3 p) {
    Vec3 image;
    for (std::size_t r = 0; r < 3; ++r) {
        const auto& row = map.rows[r];
        image[r] = float(row[0] * double(p.x) + row[1] * double(p.y) + row[2] * double(p.z) + row[3]);
    }
    return image;
}

/// True for a map that turns left into right: negative determinant.
[[nodiscard]] constexpr bool is_mirror(const Affine& map) {
    const auto& [x, y, z] = map.rows;
    return x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) +
               x[2] * (y[0] * z[1] - y[1] * z[0]) <
           0;
}

}  // namespace rtu::model
