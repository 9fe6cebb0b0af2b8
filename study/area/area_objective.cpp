#include "study/area/area_objective.hpp"

#include "study/area/area_model.hpp"
#include "study/report/run_report.hpp"

namespace rtu::study {

double machine_gates(const sim::Config& config) {
    return total(rtu_area(config)).gates.gates * config.rtu.count;
}

double mrps_per_mgate(const sim::Config& config, const sim::MachineResult& result) {
    return mrps(result.ray_count, result.cycles, config.clock_mhz) / (machine_gates(config) / 1e6);
}

}  // namespace rtu::study
