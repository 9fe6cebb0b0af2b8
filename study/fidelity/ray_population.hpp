#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/workload.hpp"
#include "traces/ray_stream.hpp"

namespace rtu::study {

/// Some rays of a population, and the position of each.
struct PopulationPart {
    std::vector<model::Ray> rays;
    std::vector<std::uint32_t> positions;  ///< [rays.size()], ascending
};

/// The rays of one workload, to be looked at in parts: each of `size()` positions has a ray or none. The
/// order of the positions is the order in which a run hands the rays to the machine.
class RayPopulation {
  public:
    /// How many positions to make at a time.
    static constexpr std::uint32_t part_positions = 1 << 16;

    RayPopulation() = default;
    RayPopulation(const RayPopulation&) = delete;
    RayPopulation& operator=(const RayPopulation&) = delete;
    virtual ~RayPopulation() = default;

    [[nodiscard]] virtual const std::string& name() const = 0;
    [[nodiscard]] virtual model::RayKind kind() const = 0;
    [[nodiscard]] virtual std::uint32_t size() const = 0;
    /// Positions after which rays start beside each other again: a picture's row, or a guess.
    [[nodiscard]] virtual std::uint32_t row_length() const = 0;
    /// The rays at positions [begin, end).
    [[nodiscard]] virtual PopulationPart part(std::uint32_t begin, std::uint32_t end) const = 0;
    /// The rays at some positions, ascending.
    [[nodiscard]] virtual PopulationPart part(std::span<const std::uint32_t> positions) const = 0;
};

/// A workload of a picture: a position is a pixel. What `setting` refers to must outlive it.
[[nodiscard]] std::unique_ptr<RayPopulation> picture_population(model::WorkloadKind kind,
                                                                const model::WorkloadSetting& setting);

/// The workloads of a file of rays, held in memory: a position is a ray, and where the file tells of a
/// picture its rays are taken to be spread evenly over the rows. Throws Error as the reader does.
[[nodiscard]] std::vector<std::unique_ptr<RayPopulation>> file_populations(traces::RayReader& rays);

}  // namespace rtu::study
