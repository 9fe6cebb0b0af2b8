#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "model/random.hpp"
#include "study/stability/stability_subject.hpp"
#include "study/stability/stability_tally.hpp"

namespace rtu::study {

/// What an experiment can tell; the other counts of its tallies are not zero but unknown.
struct Measured {
    bool crossings = false;  ///< leaks, parity errors
    bool doubles = false;    ///< doubles
    bool triangles = false;  ///< false hits and misses, wrong owners, errors of t, u, v
    bool self_hits = false;
    bool variants = false;
    bool order = false;
    bool boxes = false;
};

using Subjects = std::span<const std::unique_ptr<Subject>>;

/// One ray's worth of an experiment at a time, so that rays can be shared out to threads.
class Experiment {
  public:
    virtual ~Experiment() = default;
    [[nodiscard]] virtual Measured measured() const = 0;
    /// Draws one ray and adds what every subject makes of it to tallies [subjects.size()]; adds no ray to the
    /// tally of a subject that the experiment cannot ask.
    virtual void examine(model::RandomStream& random, Subjects subjects, std::span<Tally> tallies) const = 0;
    /// Triangles that each subject is asked for; settings of many take fewer rays.
    [[nodiscard]] virtual std::size_t triangles_per_ray() const { return 1; }
};

/// A ray and a triangle.
struct Probe {
    model::Ray ray;
    model::methods::Corners corners;
};
using DrawProbe = std::function<Probe(model::RandomStream&)>;

/// How the processor treats subnormal numbers while a method is asked.
enum class Subnormals : std::uint8_t { Kept, Flushed };

/// False where flushing cannot be switched: Flushed is Kept there.
[[nodiscard]] bool can_flush_subnormals();

/// One triangle, every decision held against the oracle.
[[nodiscard]] std::unique_ptr<Experiment> triangle_experiment(DrawProbe draw,
                                                              Subnormals subnormals = Subnormals::Kept);

/// A ray and a few triangles that make a surface, not always a closed one.
struct Fan {
    model::Ray ray;
    std::vector<model::methods::Corners> triangles;
};
using DrawFan = std::function<Fan(model::RandomStream&)>;

/// Several triangles, their hits held against those of exact arithmetic.
[[nodiscard]] std::unique_ptr<Experiment> fan_experiment(DrawFan draw, std::size_t triangles);

/// Triangles around one edge, (a, b, ...) and (b, a, ...) in turn, and a ray at the edge: all triangles on
/// one side of it must be hit and none on the other, as the DXR specification has it.
[[nodiscard]] std::unique_ptr<Experiment> edge_experiment(DrawFan draw, std::size_t triangles);

using DrawRay = std::function<model::Ray(model::RandomStream&)>;

/// Whether rays run across a surface, or may run along it, where facings are a matter of rounding.
enum class View : std::uint8_t { Across, Along };

/// A whole surface, all triangles of which the oracle judges.
[[nodiscard]] std::unique_ptr<Experiment> surface_experiment(std::shared_ptr<const Surface> surface,
                                                             DrawRay draw, View view = View::Across);

/// A closed surface at one place, and rays at it.
struct PlacedRays {
    std::shared_ptr<const Surface> surface;
    DrawRay draw;
};

/// A closed surface at several places in turn. Rays from inside, most of which cross it once: the oracle is
/// asked only where a method says otherwise. So only leaks, doubles and parity, but 10 times as many rays.
[[nodiscard]] std::unique_ptr<Experiment> watertight_experiment(std::vector<PlacedRays> places);

/// A surface too large to be tested triangle by triangle, and rays that cross it an odd number of times: only
/// subjects that are not exhaustive, only leaks and parity.
[[nodiscard]] std::unique_ptr<Experiment> inside_experiment(std::shared_ptr<const Surface> surface,
                                                            DrawRay draw);

}  // namespace rtu::study
