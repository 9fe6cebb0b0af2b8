#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/camera.hpp"
#include "model/pairing.hpp"
#include "model/workload.hpp"
#include "sim/effective_config.hpp"
#include "study/named_machine.hpp"
#include "study/pairing/pairing_rotation.hpp"

namespace rtu::study {

/// What a study varies; see pairing_studies() for what each is called and means.
enum class PairingStudyKind : std::uint8_t {
    Window,
    Rotation,
    RayKind,
    Preset,
    L1Size,
    L2Size,
    DramBandwidth,
    Testers
};

/// What to compare, and with which rays on which machine. Everything is validated by whoever fills this in.
struct PairingOptions {
    model::PairingMethod baseline{model::PairingKind::Window, 2};
    std::vector<model::PairingMethod> methods;  ///< each is compared with the baseline
    model::EdgeIdentity edge_identity = model::EdgeIdentity::Position;
    std::vector<model::WorkloadKind> workloads;
    model::Resolution resolution;
    std::optional<std::filesystem::path> camera_file;  ///< as in RunOptions
    std::uint64_t seed = 1;
    RotationDegrees rotation{};  ///< of the mesh and its camera together
    std::string preset = "default";
    sim::EffectiveConfig machine;
    std::vector<NamedMachine> presets;      ///< the points of the study `preset`
    std::vector<PairingStudyKind> studies;  ///< besides the comparison itself
    /// Told at the start of each phase, and now and then within one; may be empty.
    std::function<void(std::string_view phase)> progress;
};

}  // namespace rtu::study
