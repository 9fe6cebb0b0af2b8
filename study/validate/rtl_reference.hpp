#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "model/traversal.hpp"
#include "sim/config.hpp"

namespace rtu::study {

/// What the RTL gives for some rays.
struct ReferenceResult {
    std::uint64_t cycles = 0;  ///< from the first ray accepted to the last hit returned
    model::TraversalCounts counts;
    std::uint64_t spilled_entries = 0;
    std::vector<std::optional<model::Hit>> hits;  ///< [rays]
};

/// Runs rays through the reference of a machine. Throws Error for a machine that the reference does not have.
using ReferenceMachine =
    std::function<ReferenceResult(const sim::Config& config, const model::MemoryImage& image,
                                  std::span<const model::Ray> rays, model::RayKind kind)>;

/// The signals of [first_cycle, end_cycle), in a file whose name ends in .vcd or .fst.
struct WaveWindow {
    std::filesystem::path file;
    std::uint64_t first_cycle = 0;
    std::uint64_t end_cycle = 0;
};

/// The Verilated RTU; with `waves`, every run writes them anew. Throws Error when this was built without
/// Verilator.
[[nodiscard]] ReferenceMachine rtl_reference(const std::optional<WaveWindow>& waves = std::nullopt);

/// Throws Error, naming the key, for a machine that the RTU in SystemVerilog is not.
void check_is_rtl_machine(const sim::Config& config);

}  // namespace rtu::study
