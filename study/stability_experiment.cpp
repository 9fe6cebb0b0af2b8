#include "study/stability_experiment.hpp"

#include <algorithm>

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
            crossings_ += decision.is_hit() ? 1 : 0;
        }
    }

    void judge(std::span<const SurfaceHit> hits, Tally& tally) const {
        ++tally.rays;
        if (hits.size() < crossings_) ++tally.leaks;
        if (hits.size() > crossings_) ++tally.doubles;
        if (hits.size() % 2 != crossings_ % 2) ++tally.parity_errors;
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
        // Of a surface they are counted by ray, and apart from leaks and doubles.
        const bool is_wrong_owner = hits.size() == crossings_ && owners != crossings_;
        tally.wrong_owners = wrong_owners + (is_wrong_owner ? 1 : 0);
    }

  private:
    struct Touched {
        std::uint32_t id;
        OracleDecision decision;
    };
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
};

class FanExperiment : public Experiment {
  public:
    FanExperiment(DrawFan draw, std::size_t triangles) : draw_(std::move(draw)), triangles_(triangles) {}

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
            truth.judge(hits, tallies[i]);
        }
    }

  private:
    DrawFan draw_;
    std::size_t triangles_;
};

class SurfaceExperiment : public Experiment {
  public:
    SurfaceExperiment(std::shared_ptr<const Surface> surface, DrawRay draw)
        : surface_(std::move(surface)), draw_(std::move(draw)) {}

    [[nodiscard]] Measured measured() const override {
        return {.crossings = true, .doubles = true, .triangles = true};
    }
    [[nodiscard]] std::size_t triangles_per_ray() const override { return surface_->corners.size(); }
    void examine(RandomStream& random, Subjects subjects, std::span<Tally> tallies) const override {
        const Ray ray = draw_(random);
        const Truth truth(ray, surface_->corners);
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            truth.judge(subjects[i]->all_hits(ray, *surface_), tallies[i]);
        }
    }

  private:
    std::shared_ptr<const Surface> surface_;
    DrawRay draw_;
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
    return std::make_unique<FanExperiment>(std::move(draw), triangles);
}

std::unique_ptr<Experiment> surface_experiment(std::shared_ptr<const Surface> surface, DrawRay draw) {
    return std::make_unique<SurfaceExperiment>(std::move(surface), std::move(draw));
}

std::unique_ptr<Experiment> inside_experiment(std::shared_ptr<const Surface> surface, DrawRay draw) {
    return std::make_unique<InsideExperiment>(std::move(surface), std::move(draw));
}

}  // namespace rtu::study
