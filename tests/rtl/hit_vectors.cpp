#include "hit_vectors.hpp"

#include <cmath>
#include <limits>

#include "model/exact_sum.hpp"
#include "model/exact_triangle.hpp"
#include "model/pair_test.hpp"

namespace rtu::test {

using model::Hit;
using model::Vec3;

namespace {

// Triangle by triangle, the hits that are better than what was before them.
std::array<std::optional<Hit>, 2> better_hits(const HitVector& vector) {
    const model::PairHits found = model::test_pair(vector.pair.pair, vector.pair.ray);
    std::array<std::optional<Hit>, 2> better;
    std::optional<Hit> best = vector.best;
    for (std::size_t i = 0; i < 2; ++i) {
        const Hit& hit = found.hits[i];
        const float t_best = best ? best->t : vector.t_max;
        if (!found.is_pierced[i]) continue;
        if (hit.t < t_best || (best && hit.t == t_best && hit.primitive_id < best->primitive_id))
            best = better[i] = hit;
    }
    return better;
}

// One of a pair's triangles, in the stored order of its corners.
struct Stored {
    Stored(const PairVector& vector, std::uint32_t triangle)
        : ray(vector.ray),
          corners{vector.pair.vertices[0], vector.pair.vertices[1 + triangle],
                  vector.pair.vertices[2 + triangle]} {}

    // What settles the side of an edge that the ray is exactly on comes from kx first.
    [[nodiscard]] std::uint32_t ties(std::size_t edge) const {
        if (exact.edge_function(edge).value != 0) return 0;
        const Vec3 &p = corners[edge], &q = corners[(edge + 1) % 3], &d = ray.direction;
        const double along = d[ray.kz], across = d[ray.ky];
        const model::ExactSum sum(std::array{along * double(p[ray.ky]), -(along * double(q[ray.ky])),
                                             -(across * double(p[ray.kz])), across * double(q[ray.kz])});
        return sum.value() != 0 ? 1 : 2;
    }
    [[nodiscard]] model::Side side(std::size_t edge) const {
        return exact.side(edge, exact.edge_function(edge));
    }
    [[nodiscard]] bool is_inside() const {
        return side(0) != model::Side::Neither && side(0) == side(1) && side(1) == side(2);
    }

    const model::RaySetup& ray;
    std::array<Vec3, 3> corners;
    model::ExactTriangle exact{{ray.origin, ray.direction, ray.kz}, corners};
};

}  // namespace

std::optional<Hit> better_hit_in_model(const HitVector& vector) {
    const auto better = better_hits(vector);
    return better[1] ? better[1] : better[0];
}

bool is_inside_exactly(const PairVector& vector, std::uint32_t triangle) {
    return Stored(vector, triangle).is_inside();
}

// The model counts them as well, and so do its two tests of a pair of which one triangle is out of the way.
SecondPass second_pass_in_model(const HitVector& vector) {
    SecondPass result{vector};
    for (std::uint32_t i = 0; i < (vector.pair.pair.has_second() ? 2U : 1U); ++i) {
        model::LeafPair pair = vector.pair.pair;
        pair.flags |= 1U << (9 - i);
        const model::PairHits found = model::test_pair(pair, vector.pair.ray);
        result.goes_on = std::uint8_t(result.goes_on | found.exact_tests << i);
        result.is_inside = std::uint8_t(result.is_inside | (found.exact_tests - found.side_tests) << i);
    }
    return result;
}

HitPath path_of(const SecondPass& vector) {
    constexpr std::uint64_t not_better = 56, better = 92, sides = 111, tie = 37;
    const auto hits = better_hits(vector.hit);
    HitPath path;
    for (std::uint32_t i = 0; i < 2; ++i) {
        if ((vector.goes_on >> i & 1U) == 0) continue;
        const Stored triangle(vector.hit.pair, i);
        ++path.decided;
        path.better += hits[i] ? 1 : 0;
        bool are_sides_equal = true;
        if ((vector.is_inside >> i & 1U) == 0) {
            const std::uint32_t ties = triangle.ties(0) + triangle.ties(1) + triangle.ties(2);
            ++path.open;
            path.ties += ties;
            path.cycles += sides + ties * tie;
            are_sides_equal = triangle.is_inside();
        }
        path.cycles += !are_sides_equal ? 1 : hits[i] ? better : not_better;
    }
    return path;
}

HitVector DrawHit::operator()() {
    HitVector vector;
    vector.pair = draw_pair_();
    if (random_.one_in(4)) draw_between(vector.pair);
    auto& pair = vector.pair.pair;
    const auto order = [&] { return random_.below(3) | random_.below(2) << 2; };
    pair.flags |= order() << 1 | order() << 4;
    pair.primitive_ids = {std::uint32_t(random_.bits()), std::uint32_t(random_.bits())};
    if (random_.one_in(4)) pair.primitive_ids[1] = pair.primitive_ids[0] ^ (1U << random_.below(32));
    if (!pair.has_second()) pair.primitive_ids[1] = pair.primitive_ids[0];
    draw_range(vector);
    return vector;
}

// 24 random bits, the last one set.
float DrawHit::messy(int exponent) {
    return std::ldexp(float(random_.below(1U << 22) * 2 + (1U << 23) + 1), exponent - 23) *
           (random_.one_in(2) ? 1.0F : -1.0F);
}

// The ray runs along an axis. A rectangle across it is at a distance of 25 bits, or the ray is 25 bits away
// from its sides, which are 2 long.
void DrawHit::draw_between(PairVector& vector) {
    const std::size_t kz = random_.below(3), kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    const int scale = int(random_.below(40)) - 20;
    const float size = std::ldexp(1.0F, scale);
    std::array<float, 2> low{}, origin{};
    for (std::size_t i = 0; i < 2; ++i) {
        low[i] = -std::fabs(messy(scale));
        origin[i] = random_.one_in(4) ? low[i] + size : random_.uniform(low[i], low[i] + 2 * size);
    }
    const float plane = messy(scale);
    auto& v = vector.pair.vertices;
    for (std::size_t i = 0; i < 4; ++i) {
        v[i][kx] = low[0] + (i == 1 || i == 2 ? 2 * size : 0.0F);
        v[i][ky] = low[1] + (i == 2 || i == 3 ? 2 * size : 0.0F);
        v[i][kz] = plane;
    }
    if (random_.one_in(2)) {  // no longer square, so that only one of u and v is short
        for (Vec3& corner : v) corner[ky] *= 1.0F + std::fabs(messy(-3));
    }
    if (random_.one_in(2)) {  // beside the midpoint, by less than the leading bits of the sums tell
        const std::size_t tilted = random_.one_in(2) ? kz : kx;
        for (const std::size_t i : {2, 3}) v[i][tilted] = near(v[i][tilted]);
        origin[1] = v[0][ky] + std::ldexp(size, -8 - int(random_.below(20)));
    }
    if (!vector.pair.has_second()) v[3] = v[2];
    Vec3 from, along;
    from[kx] = origin[0];
    from[ky] = origin[1];
    from[kz] = random_.one_in(8) ? plane : -plane + messy(scale - int(random_.below(3)));
    along[kz] = random_.one_in(2) ? std::ldexp(1.0F, int(random_.below(8)) - 4) : messy(0);
    vector.ray = model::make_ray_setup({from, 0, along, std::numeric_limits<float>::infinity()}, {});
}

float DrawHit::near(float x) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    switch (random_.below(3)) {
        case 0:
            return std::nextafter(x, -infinity);
        case 1:
            return std::nextafter(x, infinity);
        default:
            return x;
    }
}

void DrawHit::draw_range(HitVector& vector) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    auto& ray = vector.pair.ray;
    vector.t_max = infinity;
    if (random_.one_in(4)) ray.t_min = -infinity;
    const model::PairHits found = model::test_pair(vector.pair.pair, ray);
    const std::uint32_t triangle = random_.below(2);
    const float t = found.is_pierced[triangle] ? found.hits[triangle].t : random_.uniform(0, 4);
    if (random_.one_in(8)) ray.t_min = near(t);
    if (random_.one_in(8)) vector.t_max = near(t);
    if (random_.one_in(3)) {
        const std::uint32_t id = vector.pair.pair.primitive_ids[triangle];
        vector.best = Hit{.t = random_.one_in(4) ? 2 * t : near(t),
                          .primitive_id = random_.one_in(2) ? id ^ (1U << random_.below(32)) : id};
    }
    ray.t_max = vector.t_max;
}

}  // namespace rtu::test
