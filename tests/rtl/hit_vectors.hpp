#pragma once

// Pairs of triangles, rays and best hits so far for the RTL tests of the second pass.

#include <optional>

#include "pair_vectors.hpp"

namespace rtu::test {

/// A pair with a ray, and the best hit that the ray has so far.
struct HitVector {
    PairVector pair;
    std::optional<model::Hit> best;
    float t_max = 0;  ///< where there is no hit yet

    [[nodiscard]] float t_best() const { return best ? best->t : t_max; }
};

/// What the traversal's rule makes of a pair: the better hit of the pair, if there is one.
std::optional<model::Hit> better_hit_in_model(const HitVector& vector);

/// Whether the ray passes all three edges of a triangle of the pair on the same side.
bool is_inside_exactly(const PairVector& vector, std::uint32_t triangle);

/// Draws the pairs of DrawPair, and others whose t, or u and v, lie exactly between two binary32 numbers, or
/// just beside, while the sums that they are quotients of are long. The file's orders of corners vary; t_min
/// and the best hit are often at the pair's own distances or next to them.
class DrawHit {
  public:
    explicit DrawHit(std::uint64_t seed) : random_(seed), draw_pair_(seed) {}
    HitVector operator()();

  private:
    float messy(int exponent);
    float near(float x);
    void draw_between(PairVector& vector);
    void draw_range(HitVector& vector);

    RandomBits random_;
    DrawPair draw_pair_;
};

}  // namespace rtu::test
