#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "study/pairing/pairing_options.hpp"
#include "study/pairing/pairing_run.hpp"
#include "study/scene_steps.hpp"

namespace rtu::study {

/// Under what a pairing is measured.
struct PairingSetting {
    sim::Config config;
    RotationDegrees rotation{};
    std::vector<model::WorkloadKind> workloads;
};

/// One scene on which pairings are measured. Reads the scene once, makes the rays of a workload once for each
/// rotation (they are the same under every pairing and tree, because the hits are bit-equal), and simulates
/// nothing twice. One image is kept: measure all settings of one method before the next method.
class PairingBench {
  public:
    /// Loads the scene and chooses its camera. `options` and `source` must outlive the bench.
    PairingBench(const PairingOptions& options, const SceneSource& source);

    /// The counts of `rtusim run` with the same pairing, machine, rays and camera.
    [[nodiscard]] PairingRun run(model::PairingMethod method, const PairingSetting& setting);

    /// What edge_bbsa_compressed costs on the scene turned so.
    [[nodiscard]] model::CompressionCost compression_cost(const RotationDegrees& rotation);

    [[nodiscard]] const LoadedScene& scene() const { return scene_; }
    /// Before any rotation.
    [[nodiscard]] const ChosenCamera& camera() const { return camera_; }

  private:
    using TreeKey = std::tuple<std::string, RotationDegrees, std::uint32_t, std::uint32_t, model::NodeFormat,
                               sim::SplitKind, std::uint32_t, sim::BvhBuilder>;
    using RunKey = std::tuple<TreeKey, model::WorkloadKind, std::string>;
    using TreeFacts = std::pair<PairingFacts, BvhFacts>;

    [[nodiscard]] static TreeKey tree_key(model::PairingMethod method, const PairingSetting& setting);
    void tell(const std::string& phase) const;
    [[nodiscard]] const model::TriangleMesh& mesh() const { return turned_ ? *turned_ : scene_.mesh; }
    void turn(const RotationDegrees& rotation);
    const BuiltScene& build(model::PairingMethod method, const PairingSetting& setting);
    const TreeFacts& tree_facts(model::PairingMethod method, const PairingSetting& setting);
    const model::Workload& rays(model::WorkloadKind kind, const model::MemoryImage& image);
    const WorkloadReport& simulated(model::PairingMethod method, const PairingSetting& setting,
                                    model::WorkloadKind kind);

    const PairingOptions& options_;
    const SceneSource& source_;
    LoadedScene scene_;
    ChosenCamera camera_;
    RotationDegrees rotation_{};                 // of all below
    std::optional<model::TriangleMesh> turned_;  // nothing for no rotation
    std::map<model::WorkloadKind, model::Workload> rays_;
    TreeKey built_key_;
    std::optional<BuiltScene> built_;
    std::map<TreeKey, TreeFacts> tree_facts_;
    std::map<RunKey, WorkloadReport> reports_;
};

}  // namespace rtu::study
