#pragma once

#include "study/stability/stability_experiment.hpp"

// Experiments whose expected answer is another answer of the same method.

namespace rtu::study {

/// What must not change the decision.
enum class Change : std::uint8_t {
    Rotation,     ///< another corner first
    Winding,      ///< two corners exchanged
    Axes,         ///< axes permuted and mirrored, of ray and triangle alike: 48 ways; not asked on a border,
                  ///< where a tie rule may look at the axes
    PowerOfTwo,   ///< the direction times 2^k, t divided by it: k = -20, -1, 1, 20
    Contraction,  ///< the compiler's fused multiply-adds, against the same method without
    Shrinking     ///< t_max just above a hit's t, or twice it; and t_max = t or below it must end the hit
};

/// variant_errors: rays for which some change of the kind changes the decision (for Shrinking and PowerOfTwo,
/// any bit of t). Rays at the inside, edges, vertices and the surroundings of triangles in turn.
[[nodiscard]] std::unique_ptr<Experiment> variant_experiment(DrawProbe draw, Change change);

/// Where a secondary ray starts.
enum class Start : std::uint8_t {
    PointOfT,        ///< origin + t * direction
    PointOfWeights,  ///< (1 - u - v) a + u b + v c
    MovedOffSurface  ///< that, moved off the surface by a bound of its error: model::surface_point()
};

/// self_hits: of the rays that hit, those whose secondary ray in a random direction (of the side to which it
/// was moved, where it was) hits the same triangle again.
[[nodiscard]] std::unique_ptr<Experiment> self_hit_experiment(DrawProbe draw, Start start);

/// order_errors: of two hits, the farther one called nearer, or different t for equal ones. The second
/// triangle is the first one with its corners rotated (0), or moved along the ray by this many units in the
/// last place of its coordinates.
[[nodiscard]] std::unique_ptr<Experiment> order_experiment(DrawProbe draw, float ulps);

/// The slab test of the machine, or the textbook's (no padding, t = (plane - origin) * (1 / direction)).
enum class Slab : std::uint8_t { Machine, Textbook };

/// box_errors: of all hits, those whose triangle's own box the slab test culls, or says to begin behind the
/// hit.
[[nodiscard]] std::unique_ptr<Experiment> box_experiment(DrawProbe draw, Slab slab);

}  // namespace rtu::study
