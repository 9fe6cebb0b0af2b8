#pragma once

// Pairs of triangles and rays for the RTL tests of the pair test.

#include <cstring>

#include "model/memory_image.hpp"
#include "model/ray_setup.hpp"
#include "vectors.hpp"

namespace rtu::test {

/// A pair with a ray.
struct PairVector {
    model::LeafPair pair{};
    model::RaySetup ray;
    std::uint8_t tag = 0;
};

/// The triangles that the model's first pass lets through: bit per triangle.
std::uint32_t goes_on_in_model(const PairVector& vector);

/// Whether a coordinate of the pair or its ray is subnormal, or 2^64 or more.
bool has_subnormal(const PairVector& vector);
bool has_huge(const PairVector& vector);

/// Sets the inputs of a Verilated pair_reject.
template <class Unit>
void drive(Unit& unit, const PairVector& vector) {
    static_assert(sizeof unit.vertices_i == sizeof vector.pair.vertices);
    std::memcpy(&unit.vertices_i, &vector.pair.vertices, sizeof unit.vertices_i);
    std::memcpy(&unit.origin_i, &vector.ray.origin, sizeof unit.origin_i);
    unit.tag_i = vector.tag;
    unit.has_second_i = vector.pair.has_second();
    unit.is_degenerate_i = std::uint8_t(vector.pair.flags >> 8 & 3U);
    unit.kz_i = vector.ray.kz;
    unit.shear_x_i = bits_of(vector.ray.shear_x);
    unit.shear_y_i = bits_of(vector.ray.shear_y);
}

/// Draws pairs and rays of every kind: anywhere, aimed at vertices and edges or just beside them, needles,
/// far from the coordinates' origin, on a grid, of any finite numbers, tiny and huge; degenerate and lone
/// triangles among them.
class DrawPair {
  public:
    explicit DrawPair(std::uint64_t seed) : random_(seed) {}
    PairVector operator()();

  private:
    float number();
    model::Vec3 numbers() { return {number(), number(), number()}; }
    void draw_corners(model::LeafPair& pair);
    model::Vec3 draw_target(const model::LeafPair& pair);
    void draw_scene(PairVector& vector);
    void draw_numbers(PairVector& vector);
    void draw_tiny(PairVector& vector);

    RandomBits random_;
};

}  // namespace rtu::test
