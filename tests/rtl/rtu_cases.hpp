#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/builtin_scene.hpp"
#include "model/bvh.hpp"
#include "model/camera.hpp"
#include "model/pairing.hpp"
#include "model/workload.hpp"
#include "rtl_ref/harness/rtl_machine.hpp"
#include "sim/machine.hpp"

namespace rtu::test {

/// A mesh with its tree, as the machine sees it.
struct RtuScene {
    RtuScene(model::TriangleMesh a_mesh, const model::BvhOptions& options)
        : mesh(std::move(a_mesh)),
          image(model::build_bvh(mesh, model::pair_triangles(mesh, {}, model::EdgeIdentity::Position),
                                 options)) {}
    RtuScene(model::TriangleMesh a_mesh, std::uint32_t width, std::uint32_t max_leaf_pairs = 1)
        : RtuScene(std::move(a_mesh), model::BvhOptions{.width = width, .max_leaf_pairs = max_leaf_pairs}) {}

    [[nodiscard]] model::Workload rays(model::WorkloadKind kind, const model::Camera& camera,
                                       std::uint32_t columns, std::uint32_t rows) const {
        return model::make_workload(kind, mesh, image, camera, {columns, rows}, 1);
    }

    model::TriangleMesh mesh;
    model::MemoryImage image;
};

/// Whether a ray meets a triangle whose sides the first pass leaves open: the one thing of which the
/// simulator does not know to the cycle what it takes.
inline bool meets_open_sides(const model::MemoryImage& image, const model::Ray& ray, model::RayKind kind) {
    model::Traversal walk;
    if (!model::start(walk, image, ray, kind)) return false;
    do {
        if (!walk.current.ref.is_leaf()) {
            model::visit_node(walk, image);
        } else if (model::visit_pair(walk, image, 0).side_tests > 0) {
            return true;
        }
    } while (!model::is_satisfied(walk) && model::pop(walk));
    return false;
}

/// The workload without such rays.
inline model::Workload without_open_sides(const RtuScene& scene, model::Workload workload) {
    std::erase_if(workload.rays, [&](const model::Ray& ray) {
        return meets_open_sides(scene.image, ray, workload.ray_kind);
    });
    return workload;
}

/// The simulated machine that the RTU is: all that it has not in its configuration is the default's.
inline sim::Config simulated(const rtl::RtlConfig& config) {
    sim::Config machine;
    machine.bvh.width = config.width;
    machine.rtu.box.boxes_per_cycle = config.width;
    machine.rtu.pair.mode = sim::PairMode(config.mode);
    machine.rtu.pair.hit_units = config.hit_units;
    machine.rtu.ray_slots = config.slots;
    machine.rtu.stack_entries = config.stack_entries;
    machine.rtu.mailbox = {model::MailboxKind::Recent, config.mailbox_entries};
    const rtl::RtlConfig::Cache& cache = config.cache;
    machine.l1 = {
        cache.sets * cache.ways * 128, 128, 32, cache.ways, cache.banks, cache.mshrs, cache.targets_per_mshr,
        cache.latency_cycles};
    machine.memory.model = sim::MemoryModel::Flat;
    machine.memory.latency_cycles = config.memory.latency_cycles;
    machine.memory.bytes_per_cycle = config.memory.bytes_per_cycle;
    return machine;
}

}  // namespace rtu::test
