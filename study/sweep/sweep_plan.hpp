#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/sweep/sweep_designs.hpp"
#include "study/sweep/sweep_file.hpp"

namespace rtu::study {

/// A scene of a sweep, and what its rays are.
struct SweepScene {
    std::string name;
    std::string hash;  ///< fingerprint() of the mesh, 16 hex digits
    std::string rays;  ///< everything that the rays are made from, as text
    std::uint64_t triangle_count = 0;
};

/// One simulation of a sweep: a design in a scene, all workloads one after another.
struct SweepPoint {
    std::string id;    ///< fingerprint of design, scene, rays, fidelity and version, 16 hex digits
    std::string tree;  ///< names what is prepared for it: points with the same one share it
    std::size_t design = 0;
    std::size_t scene = 0;
};

/// A sweep that is known to be possible.
struct SweepPlan {
    SweepFile file;
    std::vector<SweepScene> scenes;  ///< [file.inputs.size()]
    std::vector<SweepDesign> designs;
    std::vector<SweepPoint> points;  ///< scene after scene, in the order of the designs
};

/// Makes every design, and reads every scene once for its fingerprint. Throws Error as sweep_designs() and
/// load_scene() do.
[[nodiscard]] SweepPlan make_sweep_plan(SweepFile file);

/// The run that a point stands for.
[[nodiscard]] RunOptions run_options(const SweepPlan& plan, const SweepPoint& point);

}  // namespace rtu::study
