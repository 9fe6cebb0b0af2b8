#pragma once

// Pairs of triangles and rays for the RTL tests of the pair test.

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

    RandomBits random_;
};

}  // namespace rtu::test
