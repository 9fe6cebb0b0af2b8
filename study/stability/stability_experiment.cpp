#include "study/stability/stability_experiment.hpp"

#include <algorithm>
#include <array>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace rtu::study {
namespace {

using model::RandomStream;
using model::Ray;
using model::methods::Corners;
using model::methods::TestHit;

// Flushes subnormal operands and results to zero for a while.
class FlushedSubnormals {
  public:
#if defined(__SSE__)
    explicit FlushedSubnormals(bool is_wanted) : before_(_mm_getcsr()) {
        constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x40;
        if (is_wanted) _mm_setcsr(before_ | flush_to_zero | denormals_are_zero);
    }
    ~FlushedSubnormals() { _mm_setcsr(before_); }
#else
    explicit FlushedSubnormals(bool) {}
    ~FlushedSubnormals() {}
#endif
    FlushedSubnormals(const FlushedSubnormals&) = delete;
    FlushedSubnormals& operator=(const FlushedSubnormals&) = delete;

  private:
    [[maybe_unused]] unsigned before_ = 0;
};

class TriangleExperiment : public Experiment {
  public:
    TriangleExperiment(DrawProbe draw, Subnormals subnormals)
        : draw_(std::move(draw)), is_flushed_(subnormals == Subnormals::Flushed) {}

    [[nodiscard]] Measured measured() const override { return {.triangles = true}; }
    void examine(RandomStream& random, Subjects subjects, std::span<Tally> tallies) const override {
        const Probe probe = draw_(random);
        const OracleDecision exact = decide(probe.ray, probe.corners);
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            if (!subjects[i]->tests_triangles()) continue;
            ++tallies[i].rays;
            judge_triangle(probe.ray, probe.corners, exact, ask(*subjects[i], probe), tallies[i]);
        }
    }

  private:
    [[nodiscard]] std::optional<TestHit> ask(const Subject& subject, const Probe& probe) const {
        if (!is_flushed_) return subject.test(probe.ray, probe.corners);
        const FlushedSubnormals flushed(true);
        return subject.test(probe.ray, probe.corners);
    }

    DrawProbe draw_;
    bool is_flushed_;
};

// The triangles of a surface that the ray touches, or that binary64 cannot clear of it, with what is true of
// them.
class Truth {
  public:
    Truth(const Ray& ray, std::span<const Corners> triangles) : ray_(ray), triangles_(triangles) {
        for (std::uint32_t id = 0; id < triangles.size(); ++id) {
            const OracleDecision decision = decide(ray, triangles[id]);
            if (decision.meeting == Meeting::Miss) continue;
            touched_.push_back({id, decision});
            if (!decision.is_hit()) continue;
            ++crossings_;
            net_crossings_ += facing(ray, triangles[id]);
        }
    }

    // A method may see the surface moved by its rounding errors as long as it stays one surface. At a
    // silhouette that takes away or adds a crossing in and one out, which is no leak and no double hit. Rays
    // along the surface leave open which is which: only parity counts there.
    void judge(std::span<const SurfaceHit> hits, View view, Tally& tally) const {
        ++tally.rays;
        const bool is_odd = hits.size() % 2 != crossings_ % 2;
        const bool is_broken = is_odd || (view == View::Across && hits.size() != crossings_ &&
                                          net_crossings(hits) != net_crossings_);
        tally.parity_errors += is_odd ? 1 : 0;
        tally.leaks += is_broken && hits.size() < crossings_ ? 1 : 0;
        tally.doubles += is_broken && hits.size() > crossings_ ? 1 : 0;
        judge_triangles(hits, tally, is_broken);
    }

    // Of triangles around an edge, those on one side of it are hit: all of them, and no other.
    void judge_edge(std::span<const SurfaceHit> hits, Tally& tally) const {
        std::array<std::size_t, 3> all{}, hit{};  // by the side, behind it, edge-on, before it
        const auto side = [this](std::uint32_t id) -> std::size_t {
            const int from = facing(ray_, triangles_[id]) * (id % 2 == 0 ? 1 : -1);
            return from < 0 ? 0 : from == 0 ? 1 : 2;
        };
        for (std::uint32_t id = 0; id < triangles_.size(); ++id) ++all[side(id)];
        for (const SurfaceHit& each : hits) ++hit[side(each.triangle)];
        ++tally.rays;
        const bool is_double = hit[0] != 0 && hit[2] != 0;
        const bool is_leak =
            !is_double && (hit[0] != all[0] || hit[2] != 0) && (hit[2] != all[2] || hit[0] != 0);
        tally.doubles += is_double ? 1 : 0;
        tally.leaks += is_leak ? 1 : 0;
        judge_triangles(hits, tally, is_double || is_leak);
    }

  private:
    struct Touched {
        std::uint32_t id;
        OracleDecision decision;
    };
    [[nodiscard]] int net_crossings(std::span<const SurfaceHit> hits) const {
        int net = 0;
        for (const SurfaceHit& hit : hits) net += facing(ray_, triangles_[hit.triangle]);
        return net;
    }
    // Each triangle for itself; owners by ray, where they are all that is wrong.
    void judge_triangles(std::span<const SurfaceHit> hits, Tally& tally, bool is_broken) const {
        const std::uint64_t wrong_owners = tally.wrong_owners;
        std::size_t owners = 0;
        for (const SurfaceHit& hit : hits) {
            const OracleDecision exact = decision_of(hit.triangle);
            owners += exact.is_hit() ? 1 : 0;
            judge_triangle(ray_, triangles_[hit.triangle], exact, hit.hit, tally);
        }
        for (const auto& [id, decision] : touched_) {
            if (!is_hit(hits, id)) judge_triangle(ray_, triangles_[id], decision, std::nullopt, tally);
        }
        const bool is_wrong_owner = !is_broken && (owners != crossings_ || hits.size() != crossings_);
        tally.wrong_owners = wrong_owners + (is_wrong_owner ? 1 : 0);
    }
    static bool is_hit(std::span<const SurfaceHit> hits, std::uint32_t id) {
        return std::any_of(hits.begin(), hits.end(), [id](const SurfaceHit& h) { return h.triangle == id; });
    }
    [[nodiscard]] OracleDecision decision_of(std::uint32_t id) const {
        for (const Touched& touched : touched_) {
            if (touched.id == id) return touched.decision;
        }
        return decide(ray_, triangles_[id]);
    }

    Ray ray_;
    std::span<const Corners> triangles_;
    std::vector<Touched> touched_;
    std::size_t crossings_ = 0;
    int net_crossings_ = 0;  // from one side less from the other
};

class FanExperiment : public Experiment {
  public:
    FanExperiment(DrawFan draw, std::size_t triangles, bool is_edge)
        : draw_(std::move(draw)), triangles_(triangles), is_edge_(is_edge) {}

    [[nodiscard]] Measured measured() const override {
        return {.crossings = true, .doubles = true, .triangles = true};
    }
    [[nodiscard]] std::size_t triangles_per_ray() const override { return triangles_; }
    void examine(RandomStream& random, Subjects subjects, std::span<Tally> tallies) const override {
        const Fan fan = draw_(random);
        const Truth truth(fan.ray, fan.triangles);
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            if (!subjects[i]->tests_triangles()) continue;
            std::vector<SurfaceHit> hits;
            for (std::uint32_t id = 0; id < fan.triangles.size(); ++id) {
                if (const auto hit = subjects[i]->test(fan.ray, fan.triangles[id]))
                    hits.push_back({id, *hit});
            }
            if (is_edge_) {
                truth.judge_edge(hits, tallies[i]);
            } else {
                truth.judge(hits, View::Across, tallies[i]);
            }
        }
    }

  private:
    DrawFan draw_;
    std::size_t triangles_;
    bool is_edge_;
};

class SurfaceExperiment : public Experiment {
  public:
    SurfaceExperiment(std::shared_ptr<const Surface> surface, DrawRay draw, View view)
        : surface_(std::move(surface)), draw_(std::move(draw)), view_(view) {}

    [[nodiscard]] Measured measured() const override {
        return {.crossings = true, .doubles = true, .triangles = true};
    }
    [[nodiscard]] std::size_t triangles_per_ray() const override { return surface_->corners.size(); }
    void examine(RandomStream& random, Subjects subjects, std::span<Tally> tallies) const override {
        const Ray ray = draw_(random);
        const Truth truth(ray, surface_->corners);
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            truth.judge(subjects[i]->all_hits(ray, *surface_), view_, tallies[i]);
        }
    }

  private:
    std::shared_ptr<const Surface> surface_;
    DrawRay draw_;
    View view_;
};

class WatertightExperiment : public Experiment {
  public:
    explicit WatertightExperiment(std::vector<PlacedRays> places) : places_(std::move(places)) {}

    [[nodiscard]] Measured measured() const override { return {.crossings = true, .doubles = true}; }
    [[nodiscard]] std::size_t triangles_per_ray() const override {
        return places_[0].surface->corners.size();
    }
    void examine(RandomStream& random, Subjects subjects, std::span<Tally> tallies) const override {
        const auto place = std::size_t(random.next() * float(places_.size()));
        const Surface& surface = *places_[place].surface;
        const Ray ray = places_[place].draw(random);
        std::optional<Truth> truth;
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            const std::vector<SurfaceHit> hits = subjects[i]->all_hits(ray, surface);
            if (hits.size() == 1) {
                ++tallies[i].rays;
                ++tallies[i].hits;
                continue;
            }
            if (!truth) truth.emplace(ray, surface.corners);
            truth->judge(hits, View::Across, tallies[i]);
        }
    }

  private:
    std::vector<PlacedRays> places_;
};

class InsideExperiment : public Experiment {
  public:
    InsideExperiment(std::shared_ptr<const Surface> surface, DrawRay draw)
        : surface_(std::move(surface)), draw_(std::move(draw)) {}

    [[nodiscard]] Measured measured() const override { return {.crossings = true}; }
    void examine(RandomStream& random, Subjects subjects, std::span<Tally> tallies) const override {
        const Ray ray = draw_(random);
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            if (subjects[i]->is_exhaustive()) continue;
            const std::size_t hits = subjects[i]->all_hits(ray, *surface_).size();
            ++tallies[i].rays;
            tallies[i].hits += hits;
            tallies[i].leaks += hits == 0 ? 1 : 0;
            tallies[i].parity_errors += hits % 2 == 0 ? 1 : 0;
        }
    }

  private:
    std::shared_ptr<const Surface> surface_;
    DrawRay draw_;
};

}  // namespace

bool can_flush_subnormals() {
#if defined(__SSE__)
    return true;
#else
    return false;
#endif
}

std::unique_ptr<Experiment> triangle_experiment(DrawProbe draw, Subnormals subnormals) {
    return std::make_unique<TriangleExperiment>(std::move(draw), subnormals);
}

std::unique_ptr<Experiment> fan_experiment(DrawFan draw, std::size_t triangles) {
    return std::make_unique<FanExperiment>(std::move(draw), triangles, false);
}

std::unique_ptr<Experiment> edge_experiment(DrawFan draw, std::size_t triangles) {
    return std::make_unique<FanExperiment>(std::move(draw), triangles, true);
}

std::unique_ptr<Experiment> surface_experiment(std::shared_ptr<const Surface> surface, DrawRay draw,
                                               View view) {
    return std::make_unique<SurfaceExperiment>(std::move(surface), std::move(draw), view);
}

std::unique_ptr<Experiment> watertight_experiment(std::vector<PlacedRays> places) {
    return std::make_unique<WatertightExperiment>(std::move(places));
}

std::unique_ptr<Experiment> inside_experiment(std::shared_ptr<const Surface> surface, DrawRay draw) {
    return std::make_unique<InsideExperiment>(std::move(surface), std::move(draw));
}

}  // namespace rtu::study
