#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "model/traversal.hpp"
#include "sim/clock_domain.hpp"
#include "sim/config.hpp"
#include "sim/counter_table.hpp"
#include "sim/hit_sink.hpp"
#include "sim/ray_supply.hpp"

namespace rtu::sim {

/// One counter's value, with its unit of measure.
struct CounterValue {
    std::string_view name;
    std::string_view unit;
    std::uint64_t value = 0;
};

/// A unit's counters as its table lists them.
template <class Counters, std::size_t N>
[[nodiscard]] std::vector<CounterValue> counter_values(const std::array<CounterRow<Counters>, N>& rows,
                                                       const Counters& counters) {
    std::vector<CounterValue> result;
    result.reserve(N);
    for (const auto& row : rows) result.push_back({row.name, row.unit, counters.*row.member});
    return result;
}

/// Where one unit's cycles went and what it counted. With several RTUs the names start with "rtuN.".
struct UnitResult {
    std::string name;
    CycleAccount cycles;
    std::vector<CounterValue> counters;
};

/// What one simulation gives.
struct MachineResult {
    Cycle cycles = 0;  ///< from the first ray accepted to the last hit returned
    std::uint64_t ray_count = 0;
    std::vector<std::optional<model::Hit>> hits;  ///< [ray_count], unless they went to a HitConsumer
    model::TraversalCounts counts;                ///< over all RTUs
    std::vector<UnitResult> units;                ///< ray source, each RTU's units, hit sink
    std::vector<UnitResult> memory;               ///< each RTU's L1; the L2 and the DRAM, or the flat memory
};

/// Told the share of the rays that have returned, now and then.
using SimulationProgress = std::function<void(double share)>;

/// Builds the machine, runs the rays of `rays` through it, from cold caches, and checks that nothing was
/// lost: rays in = rays out, fetches = tests, every unit's cycles sum to `cycles`, the RTUs' channels empty.
/// Throws std::logic_error when one of these is broken or the machine stops making progress. `config` must be
/// valid. `on_hit` is told every hit, in the order of the rays; memory does not grow with their number. The
/// image must be the one that recorded rays were recorded on. At most 2^32 - 2 rays; without any, all cycles
/// and counters are 0. Starts a new SystemC kernel: simulations of one process run one after another.
[[nodiscard]] MachineResult simulate(const Config& config, const model::MemoryImage& image, RaySupply& rays,
                                     model::RayKind kind, const HitConsumer& on_hit,
                                     ClockMode mode = ClockMode::Fast,
                                     const SimulationProgress& progress = {});

/// The same for rays in memory; the hits are in the result.
[[nodiscard]] MachineResult simulate(const Config& config, const model::MemoryImage& image,
                                     std::span<const model::Ray> rays, model::RayKind kind,
                                     ClockMode mode = ClockMode::Fast,
                                     const SimulationProgress& progress = {});

/// How far a machine has come: everything since its first cycle, over all RTUs.
struct MachineMark {
    Cycle cycles = 0;
    std::uint64_t rays = 0;  ///< handed to the RTUs
    model::TraversalCounts counts;
    std::uint64_t leaf_visits = 0;
    std::uint64_t l1_misses = 0;
    std::uint64_t l2_misses = 0;
};

/// A machine that can be stopped, looked at, have its caches warmed and go on: for measuring parts of a long
/// run. Starts from cold caches, in a new SystemC kernel; there may be one at a time. What is on its way when
/// it is destroyed is dropped. Its caches and image are those of simulate(); so are its requirements.
class MachineSession {
  public:
    MachineSession(const Config& config, const model::MemoryImage& image, RaySupply& rays,
                   model::RayKind kind);
    MachineSession(const MachineSession&) = delete;
    MachineSession& operator=(const MachineSession&) = delete;
    ~MachineSession();

    /// Goes on to the cycle in which ray `count` (from 1) is handed over, or in which the last ray returns.
    void advance_to(std::uint64_t count);
    /// Goes on until the last ray has returned, and checks what simulate() checks.
    void finish();
    [[nodiscard]] MachineMark mark() const;
    /// Puts what a read of RTU `rtu` would bring into its L1 and the L2, in no time.
    void warm(std::uint32_t rtu, std::uint64_t address, std::uint32_t size_bytes);

  private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace rtu::sim
