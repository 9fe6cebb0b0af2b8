#include "study/pairing/pairing_rotation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "model/error.hpp"

namespace rtu::study {
namespace {

struct SineCosine {
    double sine = 0;
    double cosine = 1;
};

// The series of an angle of at most pi / 4: library trigonometry differs between machines in its last bits.
SineCosine by_series(double angle) {
    SineCosine result{0, 0};
    double term = 1;
    for (int n = 0; n < 20; n += 2) {
        const double sign = n % 4 == 0 ? 1 : -1;
        result.cosine += sign * term;
        term *= angle / (n + 1);
        result.sine += sign * term;
        term *= angle / (n + 2);
    }
    return result;
}

SineCosine sine_cosine(double degrees) {
    const double quarter = std::round(degrees / 90);
    const SineCosine rest = by_series((degrees - quarter * 90) * (std::numbers::pi / 180));
    switch ((static_cast<int>(quarter) % 4 + 4) % 4) {
        case 0:
            return rest;
        case 1:
            return {rest.cosine, -rest.sine};
        case 2:
            return {-rest.sine, -rest.cosine};
        default:
            return {-rest.cosine, rest.sine};
    }
}

// Turns axis + 1 towards axis + 2.
model::Affine about_axis(std::size_t axis, double degrees) {
    const auto [sine, cosine] = sine_cosine(degrees);
    const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    model::Affine map;
    map.rows[a][a] = cosine;
    map.rows[a][b] = -sine;
    map.rows[b][a] = sine;
    map.rows[b][b] = cosine;
    return map;
}

bool is_inside(model::Vec3 p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= model::max_coordinate;
}

}  // namespace

model::Affine rotation(const RotationDegrees& degrees) {
    return about_axis(2, degrees[2]) * (about_axis(1, degrees[1]) * about_axis(0, degrees[0]));
}

model::TriangleMesh rotated(const model::TriangleMesh& mesh, const model::Affine& map) {
    model::TriangleMesh result = mesh;
    for (model::Vec3& position : result.positions) {
        position = model::transform(map, position);
        if (!is_inside(position)) {
            throw Error("{}: rotated, a coordinate is beyond {:g}", mesh.name, model::max_coordinate);
        }
    }
    return result;
}

model::Camera rotated(const model::Camera& camera, const model::Affine& map) {
    return {model::transform(map, camera.eye), model::transform(map, camera.target),
            model::transform(map, camera.up), camera.tan_half_fov};
}

}  // namespace rtu::study
