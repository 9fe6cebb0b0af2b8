#include "pair_vectors.hpp"

#include <cmath>
#include <limits>

#include "model/pair_test.hpp"

namespace rtu::test {

using model::Vec3;

// The model counts them; with the other triangle out of the way, it is this one.
std::uint32_t goes_on_in_model(const PairVector& vector) {
    std::uint32_t goes_on = 0;
    for (std::uint32_t triangle = 0; triangle < (vector.pair.has_second() ? 2U : 1U); ++triangle) {
        model::LeafPair pair = vector.pair;
        pair.flags |= 1U << (9 - triangle);
        goes_on |= model::test_pair(pair, vector.ray).exact_tests << triangle;
    }
    return goes_on;
}

namespace {

template <class Predicate>
bool any_coordinate(const PairVector& vector, Predicate is_such) {
    const auto any = [&](Vec3 v) { return is_such(v.x) || is_such(v.y) || is_such(v.z); };
    const auto& v = vector.pair.vertices;
    return any(v[0]) || any(v[1]) || any(v[2]) || any(v[3]) || any(vector.ray.origin) ||
           any(vector.ray.direction);
}

void set_ray(PairVector& vector, Vec3 origin, Vec3 direction) {
    if (direction == Vec3{}) direction.z = -1;
    vector.ray = model::make_ray_setup({origin, 0, direction, std::numeric_limits<float>::infinity()}, {});
}

}  // namespace

bool has_subnormal(const PairVector& vector) {
    return any_coordinate(vector, [](float x) { return std::fpclassify(x) == FP_SUBNORMAL; });
}

bool has_huge(const PairVector& vector) {
    return any_coordinate(vector, [](float x) { return std::fabs(x) >= 0x1p64F; });
}

PairVector DrawPair::operator()() {
    PairVector vector;
    vector.tag = std::uint8_t(random_.bits());
    if (random_.one_in(16)) {
        draw_tiny(vector);
    } else if (random_.one_in(5)) {
        draw_numbers(vector);
    } else {
        draw_scene(vector);
    }
    const bool is_lone = random_.one_in(5);
    if (is_lone) vector.pair.vertices[3] = vector.pair.vertices[2];
    vector.pair.primitive_ids = {0, is_lone ? 0U : 1U};
    vector.pair.flags = is_lone ? 0U : 1U;
    if (random_.one_in(16)) vector.pair.flags |= (random_.below(3) + 1) << 8;
    return vector;
}

// A pair of size 1, or a needle or a grid's, near the origin or far away.
void DrawPair::draw_corners(model::LeafPair& pair) {
    const std::uint32_t shape = random_.below(4);
    const float offset = random_.one_in(3) ? std::ldexp(1.0F, int(random_.below(20))) : 0.0F;
    const Vec3 centre{offset, 0.3F * offset, -offset};
    for (Vec3& v : pair.vertices) {
        v = centre + random_.point(-1, 1);
        if (shape == 1) v = {std::round(4 * v.x), std::round(4 * v.y), std::round(4 * v.z)};
    }
    if (shape == 2) {
        const Vec3 along = pair.vertices[2] - pair.vertices[0];
        const float width = std::ldexp(1.0F, -int(random_.below(24)));
        for (const std::size_t i : {1, 3}) {
            pair.vertices[i] =
                pair.vertices[0] + along * random_.uniform(0, 1) + random_.point(-width, width);
        }
    }
}

// A vertex, a point of an edge, one just beside it, or any.
Vec3 DrawPair::draw_target(const model::LeafPair& pair) {
    const std::uint32_t first = random_.below(4);
    const Vec3 a = pair.vertices[first], b = pair.vertices[(first + 1 + random_.below(2)) % 4];
    const Vec3 on_edge = a + (b - a) * random_.uniform(0, 1);
    const float beside = std::ldexp(1.0F, -int(random_.below(28)));
    switch (random_.below(4)) {
        case 0:
            return a;
        case 1:
            return on_edge;
        case 2:
            return on_edge + random_.point(-beside, beside);
        default:
            return (a + b) * 0.5F + random_.point(-1, 1);
    }
}

void DrawPair::draw_scene(PairVector& vector) {
    draw_corners(vector.pair);
    const Vec3 target = draw_target(vector.pair);
    const float distance = std::ldexp(1.0F, int(random_.below(44)) - 30);
    const bool is_straight = random_.one_in(8);
    Vec3 origin = target + random_.point(-distance, distance);
    if (is_straight) origin = {target.x, target.y, target.z - distance};
    Vec3 direction = target - origin;
    if (is_straight || direction == Vec3{}) direction = {0, random_.one_in(2) ? 0.0F : -0.0F, 1};
    vector.ray = model::make_ray_setup({origin, 0, direction, std::numeric_limits<float>::infinity()}, {});
}

float DrawPair::number() {
    while (true) {
        const float x = random_.one_in(8)   ? random_.special()
                        : random_.one_in(2) ? random_.any()
                                            : random_.of_exponent(100 + random_.below(40), 4);
        if (std::isfinite(x)) return x;
    }
}

// Every input on its own.
void DrawPair::draw_numbers(PairVector& vector) {
    for (Vec3& v : vector.pair.vertices) v = numbers();
    set_ray(vector, numbers(), numbers());
}

// So small that edge functions underflow.
void DrawPair::draw_tiny(PairVector& vector) {
    const float size = std::ldexp(1.0F, -60 - int(random_.below(12)));
    for (Vec3& v : vector.pair.vertices) v = random_.point(-size, size);
    set_ray(vector, random_.point(-size, size), random_.point(-1, 1));
}

}  // namespace rtu::test
