#include "study/fidelity/fidelity_levels.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "model/error.hpp"
#include "sim/machine.hpp"
#include "study/cpu_time.hpp"

namespace rtu::study {
namespace {

// Makes a part of the population at a time.
class PopulationSupply final : public sim::RaySupply {
  public:
    explicit PopulationSupply(const RayPopulation& population) : population_(population) {}
    [[nodiscard]] std::optional<sim::SuppliedRay> next() override {
        while (next_ == part_.rays.size()) {
            if (begin_ == population_.size()) return std::nullopt;
            const std::uint32_t end =
                begin_ + std::min(RayPopulation::part_positions, population_.size() - begin_);
            part_ = population_.part(begin_, end);
            begin_ = end;
            next_ = 0;
        }
        return sim::SuppliedRay{part_.rays[next_++], {}};
    }
    [[nodiscard]] double share() const override { return double(begin_) / double(population_.size()); }

  private:
    const RayPopulation& population_;
    PopulationPart part_;
    std::uint32_t begin_ = 0;
    std::size_t next_ = 0;
};

}  // namespace

LevelResult run_cycle(const sim::Config& config, const model::MemoryImage& image,
                      const RayPopulation& population) {
    const double start = cpu_seconds();
    PopulationSupply supply(population);
    const sim::MachineResult machine =
        sim::simulate(config, image, supply, population.kind(), [](const std::optional<model::Hit>&) {});
    LevelResult result;
    const double cycles = machine.ray_count == 0 ? 0.0 : double(machine.cycles) / double(machine.ray_count);
    result.estimate = {cycles, cycles, cycles, double(machine.ray_count)};
    result.simulated_rays = machine.ray_count;
    result.cpu_seconds = cpu_seconds() - start;
    result.level = "cycle";
    result.account = "every ray";
    return result;
}

LevelResult run_level(FidelityLevel level, const sim::Config& config, const model::MemoryImage& image,
                      const RayPopulation& population, const SampledOptions& options) {
    if (config.rtu.mailbox.is_on() && level != FidelityLevel::Cycle) {
        throw Error("rtu.mailbox: a mailbox is simulated at fidelity cycle only");
    }
    switch (level) {
        case FidelityLevel::Counts:
            return run_counts(config, image, population);
        case FidelityLevel::Analytic:
            return run_analytic(config, image, population, options.seed);
        case FidelityLevel::Sampled:
            return run_sampled(config, image, population, options);
        case FidelityLevel::Cycle:
            return run_cycle(config, image, population);
        case FidelityLevel::Rtl:
            return run_rtl(config, image, population);
        case FidelityLevel::Auto:
            break;
    }
    return run_auto(config, image, population, options);
}

FidelityLevel parse_fidelity_level(std::string_view name) {
    for (const FidelityLevel level : {FidelityLevel::Counts, FidelityLevel::Analytic, FidelityLevel::Sampled,
                                      FidelityLevel::Cycle, FidelityLevel::Rtl, FidelityLevel::Auto}) {
        if (name == to_string(level)) return level;
    }
    throw Error("expected counts, analytic, sampled, cycle, rtl or auto, got '{}'", name);
}

std::string_view to_string(FidelityLevel level) {
    constexpr std::array<std::string_view, 6> names{"counts", "analytic", "sampled", "cycle", "rtl", "auto"};
    return names[std::size_t(level)];
}

}  // namespace rtu::study
