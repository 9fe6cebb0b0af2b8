#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/sweep/sweep_designs.hpp"
#include "study/sweep/sweep_file.hpp"
#include "study/sweep/sweep_tree.hpp"

namespace rtu::study {

/// A scene of a sweep, and what its rays are.
struct SweepScene {
    std::string name;
    std::string hash;  ///< fingerprint() of the mesh, 16 hex digits
    std::string rays;  ///< everything that the rays are made from, as text
    std::uint64_t triangle_count = 0;
};

/// One simulation or estimate of a sweep: a design in a scene, all workloads one after another.
struct SweepPoint {
    std::string id;    ///< fingerprint of design, scene, rays, fidelity and version, 16 hex digits
    std::string tree;  ///< names what is prepared for it: points with the same one share it
    std::size_t design = 0;
    std::size_t scene = 0;
    FidelityLevel level = FidelityLevel::Cycle;  ///< that is asked for
};

/// True for a level whose figures depend on the tolerance.
[[nodiscard]] inline bool uses_tolerance(FidelityLevel level) {
    return level == FidelityLevel::Sampled || level == FidelityLevel::Auto;
}

/// A sweep that is known to be possible.
struct SweepPlan {
    SweepFile file;
    std::vector<SweepScene> scenes;  ///< [file.inputs.size()]
    std::vector<SweepDesign> designs;
    /// Scene after scene, in the order of the designs. When these are estimates, the same follow once more at
    /// level cycle: the second pass, of which only those that may be on the front are simulated.
    std::vector<SweepPoint> points;

    /// Of a design in a scene, at level cycle.
    [[nodiscard]] std::size_t cycle_point(std::size_t scene, std::size_t design) const {
        const std::size_t first_pass = scenes.size() * designs.size();
        return points.size() - first_pass + scene * designs.size() + design;
    }
};

/// Makes every design, and reads every scene once for its fingerprint. Throws Error as sweep_designs() and
/// load_scene() do.
[[nodiscard]] SweepPlan make_sweep_plan(SweepFile file);

/// What the point's tree is prepared with.
[[nodiscard]] inline TreeContent content_of(const SweepPoint& point) {
    return point.level == FidelityLevel::Cycle ? TreeContent::Traversals : TreeContent::Rays;
}

/// The run that a point stands for.
[[nodiscard]] RunOptions run_options(const SweepPlan& plan, const SweepPoint& point);

}  // namespace rtu::study
