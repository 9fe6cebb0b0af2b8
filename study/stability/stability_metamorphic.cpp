#include "study/stability/stability_metamorphic.hpp"

#include <array>
#include <bit>
#include <cmath>

#include "model/sampling.hpp"
#include "model/slab_test.hpp"
#include "model/surface.hpp"
#include "model/vec3.hpp"
#include "study/stability/stability_probes.hpp"

namespace rtu::study {
namespace {

using model::RandomStream;
using model::Ray;
using model::Vec3;
using model::methods::Corners;
using model::methods::TestHit;
using Answer = std::optional<TestHit>;

using model::infinity;

// An experiment that asks each subject for itself.
class PerSubject : public Experiment {
  public:
    explicit PerSubject(DrawProbe draw) : draw_(std::move(draw)) {}
    void examine(RandomStream& random, Subjects subjects, std::span<Tally> tallies) const override {
        const Probe probe = draw_(random);
        const RandomStream fresh = random;  // the same further numbers for all
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            RandomStream own = fresh;
            if (subjects[i]->tests_triangles()) examine_one(probe, own, *subjects[i], tallies[i]);
        }
    }

  private:
    virtual void examine_one(const Probe& probe, RandomStream& random, const Subject& subject,
                             Tally& tally) const = 0;
    DrawProbe draw_;
};

bool is_same_number(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

Vec3 permuted(Vec3 v, std::uint32_t symmetry) {
    constexpr std::array<std::array<std::size_t, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    const auto& order = orders[symmetry / 8];
    Vec3 result{v[order[0]], v[order[1]], v[order[2]]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if ((symmetry >> axis & 1U) != 0) result[axis] = -result[axis];
    }
    return result;
}

class VariantExperiment : public PerSubject {
  public:
    VariantExperiment(DrawProbe draw, Change change) : PerSubject(std::move(draw)), change_(change) {}
    [[nodiscard]] Measured measured() const override { return {.variants = true}; }

  private:
    void examine_one(const Probe& probe, RandomStream&, const Subject& subject, Tally& tally) const override {
        if (change_ == Change::Contraction && subject.contraction() != "fast") return;
        const Answer answer = subject.test(probe.ray, probe.corners);
        ++tally.rays;
        tally.hits += answer ? 1 : 0;
        if (!is_same(probe, answer, subject)) ++tally.variant_errors;
    }
    [[nodiscard]] bool is_same(const Probe& probe, const Answer& answer, const Subject& subject) const {
        switch (change_) {
            case Change::Rotation:
            case Change::Winding:
                return is_same_reordered(probe, answer.has_value(), subject);
            case Change::Axes:
                return is_same_turned(probe, answer.has_value(), subject);
            case Change::PowerOfTwo:
                return is_same_scaled(probe, answer, subject);
            case Change::Contraction:
                return is_same_without_contraction(probe, answer, subject);
            default:
                return !answer || is_same_shrunk(probe, *answer, subject);
        }
    }
    [[nodiscard]] bool is_same_reordered(const Probe& probe, bool is_hit, const Subject& subject) const {
        const auto& [a, b, c] = probe.corners;
        const auto is_same = [&](const Corners& corners) {
            return subject.test(probe.ray, corners).has_value() == is_hit;
        };
        return change_ == Change::Rotation ? is_same({b, c, a}) && is_same({c, a, b})
                                           : is_same({a, c, b}) && is_same({c, b, a}) && is_same({b, a, c});
    }
    static bool is_same_turned(const Probe& probe, bool is_hit, const Subject& subject) {
        const Meeting meeting = decide(probe.ray, probe.corners).meeting;
        if (meeting != Meeting::Interior && meeting != Meeting::Miss) return true;
        for (std::uint32_t symmetry = 1; symmetry < 48; ++symmetry) {
            Ray ray = probe.ray;
            ray.origin = permuted(ray.origin, symmetry);
            ray.direction = permuted(ray.direction, symmetry);
            Corners corners = probe.corners;
            for (Vec3& corner : corners) corner = permuted(corner, symmetry);
            if (subject.test(ray, corners).has_value() != is_hit) return false;
        }
        return true;
    }
    static bool is_same_scaled(const Probe& probe, const Answer& answer, const Subject& subject) {
        for (const int exponent : {-20, -1, 1, 20}) {
            Ray ray = probe.ray;
            ray.direction = ray.direction * std::ldexp(1.0F, exponent);
            const Answer other = subject.test(ray, probe.corners);
            if (other.has_value() != answer.has_value()) return false;
            if (answer && !is_same_number(std::ldexp(other->t, exponent), answer->t)) return false;
        }
        return true;
    }
    static bool is_same_without_contraction(const Probe& probe, const Answer& answer,
                                            const Subject& subject) {
        const auto* method = model::methods::find_method(subject.name());
        return method->test(probe.ray, probe.corners).has_value() == answer.has_value();
    }
    static bool is_same_shrunk(const Probe& probe, const TestHit& hit, const Subject& subject) {
        const auto with_end = [&](float t_max) {
            Ray ray = probe.ray;
            ray.t_max = t_max;
            return subject.test(ray, probe.corners);
        };
        for (const float t_max : {std::nextafter(hit.t, infinity), hit.t * 2}) {
            const Answer other = with_end(t_max);
            if (!other || !is_same_number(other->t, hit.t)) return false;
        }
        return !with_end(hit.t) && !with_end(hit.t / 2);
    }

    Change change_;
};

class SelfHitExperiment : public PerSubject {
  public:
    SelfHitExperiment(DrawProbe draw, Start start) : PerSubject(std::move(draw)), start_(start) {}
    [[nodiscard]] Measured measured() const override { return {.self_hits = true}; }

  private:
    void examine_one(const Probe& probe, RandomStream& random, const Subject& subject,
                     Tally& tally) const override {
        const Answer hit = subject.test(probe.ray, probe.corners);
        if (!hit) return;
        const std::optional<Ray> secondary = leave(probe, *hit, model::sample_sphere(random));
        if (!secondary) return;
        ++tally.rays;
        ++tally.hits;
        if (subject.test(*secondary, probe.corners)) ++tally.self_hits;
    }
    [[nodiscard]] std::optional<Ray> leave(const Probe& probe, const TestHit& hit, Vec3 direction) const {
        const auto& [a, b, c] = probe.corners;
        if (start_ == Start::PointOfT) {
            return Ray{probe.ray.origin + probe.ray.direction * hit.t, 0, direction, infinity};
        }
        if (start_ == Start::PointOfWeights) {
            return Ray{a * (1 - hit.u - hit.v) + b * hit.u + c * hit.v, 0, direction, infinity};
        }
        const model::TriangleMesh one{"", {a, b, c}, {{0, 1, 2}}};
        const auto point = model::surface_point(one, {hit.t, hit.u, hit.v, 0}, probe.ray.direction);
        if (!point) return std::nullopt;
        return Ray{point->origin, 0, dot(direction, point->normal) < 0 ? -direction : direction, infinity};
    }

    Start start_;
};

class OrderExperiment : public PerSubject {
  public:
    OrderExperiment(DrawProbe draw, float ulps) : PerSubject(std::move(draw)), ulps_(ulps) {}
    [[nodiscard]] Measured measured() const override { return {.order = true}; }

  private:
    void examine_one(const Probe& probe, RandomStream&, const Subject& subject, Tally& tally) const override {
        const Corners other = second(probe);
        const Answer near = subject.test(probe.ray, probe.corners), far = subject.test(probe.ray, other);
        if (!near || !far) return;
        const OracleDecision first = decide(probe.ray, probe.corners), next = decide(probe.ray, other);
        if (!first.is_met() || !next.is_met()) return;
        ++tally.rays;
        tally.hits += 2;
        const bool is_wrong = ulps_ == 0         ? !is_same_number(near->t, far->t)
                              : first.t < next.t ? near->t > far->t
                                                 : near->t < far->t;
        if (is_wrong) ++tally.order_errors;
    }
    [[nodiscard]] Corners second(const Probe& probe) const {
        const auto& [a, b, c] = probe.corners;
        if (ulps_ == 0) return {b, c, a};
        const Vec3 unit = model::direction_of(probe.ray.direction).value_or(Vec3{0, 0, 1});
        Corners moved = probe.corners;
        for (Vec3& corner : moved) corner = corner + unit * (ulps_ * 0x1p-23F);
        return moved;
    }

    float ulps_;
};

bool is_kept_by_textbook(const model::Aabb& box, const Ray& ray, float t) {
    float entry = ray.t_min, exit = t;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float inverse = 1 / ray.direction[axis];
        const float low = (box.lo[axis] - ray.origin[axis]) * inverse,
                    high = (box.hi[axis] - ray.origin[axis]) * inverse;
        const float near = inverse < 0 ? high : low, far = inverse < 0 ? low : high;
        entry = near > entry ? near : entry;
        exit = far < exit ? far : exit;
    }
    return entry <= exit;
}

bool is_kept_by_machine(const model::Aabb& box, const Ray& ray, float t) {
    model::Node<4> node{};
    node.child_count = 1;
    node.set_box(0, box);
    const model::SlabRay<model::slab_lanes<4>> slab_ray(model::make_ray_setup(ray, box));
    const auto kept = model::slab_test(node, slab_ray, t);
    return kept.mask != 0 && kept.t_near[0] <= t;
}

class BoxExperiment : public PerSubject {
  public:
    BoxExperiment(DrawProbe draw, Slab slab) : PerSubject(std::move(draw)), slab_(slab) {}
    [[nodiscard]] Measured measured() const override { return {.boxes = true}; }

  private:
    void examine_one(const Probe& probe, RandomStream&, const Subject& subject, Tally& tally) const override {
        const Answer hit = subject.test(probe.ray, probe.corners);
        ++tally.rays;
        if (!hit) return;
        ++tally.hits;
        model::Aabb box;
        for (const Vec3 corner : probe.corners) box.extend(corner);
        const bool is_kept = slab_ == Slab::Machine ? is_kept_by_machine(box, probe.ray, hit->t)
                                                    : is_kept_by_textbook(box, probe.ray, hit->t);
        if (!is_kept) ++tally.box_errors;
    }

    Slab slab_;
};

}  // namespace

std::unique_ptr<Experiment> variant_experiment(DrawProbe draw, Change change) {
    return std::make_unique<VariantExperiment>(std::move(draw), change);
}

std::unique_ptr<Experiment> self_hit_experiment(DrawProbe draw, Start start) {
    return std::make_unique<SelfHitExperiment>(std::move(draw), start);
}

std::unique_ptr<Experiment> order_experiment(DrawProbe draw, float ulps) {
    return std::make_unique<OrderExperiment>(std::move(draw), ulps);
}

std::unique_ptr<Experiment> box_experiment(DrawProbe draw, Slab slab) {
    return std::make_unique<BoxExperiment>(std::move(draw), slab);
}

}  // namespace rtu::study
