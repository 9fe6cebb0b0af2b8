#include "study/stability/stability_subject.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "model/pair_test.hpp"
#include "model/traversal.hpp"

namespace rtu::study {
namespace {

using model::Ray;
using model::methods::Contraction;
using model::methods::Corners;
using model::methods::Method;
using model::methods::TestHit;

class MethodSubject : public Subject {
  public:
    MethodSubject(const Method& method, Contraction contraction)
        : Subject(std::string(method.info.name), contraction == Contraction::Off ? "off" : "fast"),
          method_(method) {}

    [[nodiscard]] std::optional<TestHit> test(const Ray& ray, const Corners& corners) const override {
        auto hit = method_.test(ray, corners);
        if (hit || !method_.info.is_one_sided) return hit;
        hit = method_.test(ray, {corners[0], corners[2], corners[1]});
        if (hit) std::swap(hit->u, hit->v);
        return hit;
    }
    [[nodiscard]] std::vector<SurfaceHit> all_hits(const Ray& ray, const Surface& surface) const override {
        std::vector<SurfaceHit> hits;
        for (std::uint32_t id = 0; id < surface.corners.size(); ++id) {
            if (const auto hit = test(ray, surface.corners[id])) hits.push_back({id, *hit});
        }
        return hits;
    }

  private:
    const Method& method_;
};

void add_hits(const model::LeafPair& pair, const model::RaySetup& ray, std::vector<SurfaceHit>& hits) {
    const model::PairHits found = model::test_pair(pair, ray);
    for (std::size_t i = 0; i < 2; ++i) {
        const model::Hit& hit = found.hits[i];
        if (found.is_pierced[i] && hit.t < ray.t_max)
            hits.push_back({hit.primitive_id, {hit.t, hit.u, hit.v}});
    }
}

// The machine's pair test: alone, a triangle is a pair of its own; in a surface, triangles come in pairs.
class PairTestSubject : public Subject {
  public:
    PairTestSubject() : Subject("rtu", "off") {}

    [[nodiscard]] std::optional<TestHit> test(const Ray& ray, const Corners& corners) const override {
        return model::methods::find_method("exact")->test(ray, corners);
    }
    [[nodiscard]] std::vector<SurfaceHit> all_hits(const Ray& ray, const Surface& surface) const override {
        std::vector<SurfaceHit> hits;
        if (!model::can_hit(ray)) return hits;
        const model::RaySetup setup = model::make_ray_setup(ray, surface.image.bounds);
        for (const model::LeafPair& pair : surface.pairs) add_hits(pair, setup, hits);
        return hits;
    }
};

class SurfaceOnlySubject : public Subject {
  public:
    using Subject::Subject;
    [[nodiscard]] bool tests_triangles() const override { return false; }
    [[nodiscard]] bool is_exhaustive() const override { return false; }
    [[nodiscard]] std::optional<TestHit> test(const Ray&, const Corners&) const override {
        return std::nullopt;
    }
};

// The machine's walk through its tree with the interval left open, so that every hit is seen.
class TraversalSubject : public SurfaceOnlySubject {
  public:
    TraversalSubject() : SurfaceOnlySubject("rtu_traversal", "off") {}

    [[nodiscard]] std::vector<SurfaceHit> all_hits(const Ray& ray, const Surface& surface) const override {
        std::vector<SurfaceHit> hits;
        model::Traversal walk;
        if (!model::start(walk, surface.image, ray, model::RayKind::ClosestHit)) return hits;
        do {
            if (!walk.current.ref.is_leaf()) {
                model::visit_node(walk, surface.image);
                continue;
            }
            for (std::uint32_t i = 0; i < walk.current.ref.pair_count(); ++i) {
                add_hits(surface.image.leaf_pair(walk.current.ref, i), walk.ray, hits);
            }
        } while (model::pop(walk));
        return hits;
    }
};

class EmbreeSubject : public SurfaceOnlySubject {
  public:
    explicit EmbreeSubject(EmbreeMode mode)
        : SurfaceOnlySubject(mode == EmbreeMode::Robust ? "embree_robust" : "embree", "-"), mode_(mode) {}

    [[nodiscard]] std::vector<SurfaceHit> all_hits(const Ray& ray, const Surface& surface) const override {
        const EmbreeOracle& embree = mode_ == EmbreeMode::Robust ? surface.embree_robust : surface.embree;
        std::vector<SurfaceHit> hits;
        for (const model::Hit& hit : embree.all_hits(ray)) {
            hits.push_back({hit.primitive_id, {hit.t, hit.u, hit.v}});
        }
        return hits;
    }

  private:
    EmbreeMode mode_;
};

void add_subjects(const std::string& name, std::vector<std::unique_ptr<Subject>>& subjects) {
    for (const Contraction contraction : {Contraction::Off, Contraction::Fast}) {
        const Method* method = model::methods::find_method(name, contraction);
        if (method != nullptr) subjects.push_back(std::make_unique<MethodSubject>(*method, contraction));
    }
    if (name == "rtu") subjects.push_back(std::make_unique<PairTestSubject>());
    if (name == "rtu_traversal") subjects.push_back(std::make_unique<TraversalSubject>());
    if (name == "embree") subjects.push_back(std::make_unique<EmbreeSubject>(EmbreeMode::Default));
    if (name == "embree_robust") subjects.push_back(std::make_unique<EmbreeSubject>(EmbreeMode::Robust));
}

}  // namespace

std::vector<std::string> subject_names() {
    std::vector<std::string> names;
    for (const Method& method : model::methods::all_methods()) names.emplace_back(method.info.name);
    for (const char* name : {"rtu", "rtu_traversal", "embree", "embree_robust"}) names.emplace_back(name);
    return names;
}

std::vector<std::unique_ptr<Subject>> make_subjects(std::span<const std::string> names) {
    const std::vector<std::string> known = subject_names();
    std::vector<std::unique_ptr<Subject>> subjects;
    for (auto name = names.begin(); name != names.end(); ++name) {
        if (std::find(known.begin(), known.end(), *name) == known.end()) {
            throw Error("--method: expected {}, got '{}'", fmt::join(known, ", "), model::one_line(*name));
        }
        if (std::find(names.begin(), name, *name) != name)
            throw Error("--method: '{}' is given twice", *name);
        add_subjects(*name, subjects);
    }
    if (names.empty()) {
        for (const std::string& name : known) add_subjects(name, subjects);
    }
    return subjects;
}

}  // namespace rtu::study
