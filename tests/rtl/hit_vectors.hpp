#pragma once

// Pairs of triangles, rays and best hits so far for the RTL tests of the second pass.

#include <gtest/gtest.h>

#include <cstring>
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

/// A pair behind the first pass.
struct SecondPass {
    HitVector hit;
    std::uint8_t goes_on = 0;    ///< bit per triangle
    std::uint8_t is_inside = 0;  ///< of those, the ones whose sides are settled: all, or fewer
};

/// A pair behind the model's first pass.
SecondPass second_pass_in_model(const HitVector& vector);

/// What the hit unit goes through for a pair.
struct HitPath {
    std::uint64_t cycles = 0;   ///< from the pair to its result, without what midpoints take
    std::uint32_t decided = 0;  ///< triangles, 0 to 2
    std::uint32_t open = 0;     ///< of those, the ones whose sides are not settled
    std::uint32_t ties = 0;     ///< edges, or directions in which they are seen, that the ray is exactly on
    std::uint32_t better = 0;   ///< triangles that are a better hit than what was before them
};
HitPath path_of(const SecondPass& vector);

/// Cycles that rounding by an exact midpoint takes: of t and u, and one more of v.
inline constexpr std::uint64_t midpoint_cycles = 162;

/// Sets the inputs of a Verilated hit_unit.
template <class Unit>
void drive(Unit& unit, const SecondPass& vector) {
    const auto& [pair, ray, tag] = vector.hit.pair;
    std::memcpy(&unit.vertices_i, &pair.vertices, sizeof unit.vertices_i);
    std::memcpy(&unit.primitive_ids_i, &pair.primitive_ids, sizeof unit.primitive_ids_i);
    std::memcpy(&unit.origin_i, &ray.origin, sizeof unit.origin_i);
    std::memcpy(&unit.direction_i, &ray.direction, sizeof unit.direction_i);
    unit.tag_i = tag;
    unit.corner_order_i = pair.flags >> 1 & 63U;
    unit.goes_on_i = vector.goes_on;
    unit.is_inside_i = vector.is_inside;
    unit.kz_i = ray.kz;
    unit.t_min_i = bits_of(ray.t_min);
    unit.t_best_i = bits_of(vector.hit.t_best());
    unit.has_best_i = vector.hit.best.has_value();
    unit.best_id_i = vector.hit.best ? vector.hit.best->primitive_id : 0;
}

/// Compares the outputs of a Verilated hit_unit or pair_tester.
template <class Unit>
void expect_as_model(const Unit& rtl, const HitVector& vector) {
    const auto expected = better_hit_in_model(vector);
    ASSERT_EQ(bool(rtl.found_o), expected.has_value());
    if (!expected) return;
    ASSERT_EQ(rtl.primitive_id_o, expected->primitive_id);
    ASSERT_EQ(rtl.t_o, bits_of(expected->t));
    ASSERT_EQ(rtl.u_o, bits_of(expected->u));
    ASSERT_EQ(rtl.v_o, bits_of(expected->v));
}

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
