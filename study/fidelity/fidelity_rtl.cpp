#include "model/error.hpp"
#include "study/cpu_time.hpp"
#include "study/fidelity/fidelity_levels.hpp"
#include "study/validate/rtl_reference.hpp"

namespace rtu::study {

LevelResult run_rtl(const sim::Config& config, const model::MemoryImage& image,
                    const RayPopulation& population) {
    constexpr std::uint32_t most_positions = 65536;
    if (population.size() > most_positions) {
        throw Error("fidelity rtl: expected at most {} rays, got {}; a smaller picture will do",
                    most_positions, population.size());
    }
    const ReferenceMachine reference = rtl_reference();
    const double start = cpu_seconds();
    const PopulationPart all = population.part(0, population.size());
    LevelResult result;
    result.level = "rtl";
    result.account = "every ray through the Verilated RTU";
    result.simulated_rays = all.rays.size();
    if (!all.rays.empty()) {
        const ReferenceResult rtl = reference(config, image, all.rays, population.kind());
        const double rays = double(all.rays.size()), cycles = double(rtl.cycles) / rays;
        result.estimate = {cycles, cycles, cycles, rays};
    }
    result.cpu_seconds = cpu_seconds() - start;
    return result;
}

}  // namespace rtu::study
