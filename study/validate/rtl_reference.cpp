#include "study/validate/rtl_reference.hpp"

#include "model/error.hpp"

#ifdef RTUSIM_HAS_RTL
#include "rtl_ref/harness/rtl_machine.hpp"
#endif

namespace rtu::study {

#ifdef RTUSIM_HAS_RTL
namespace {

rtl::RtlConfig rtl_config(const sim::Config& config) {
    rtl::RtlConfig machine;
    machine.width = config.bvh.width;
    machine.mode = rtl::TesterMode(config.rtu.pair.mode);
    machine.hit_units = config.rtu.pair.hit_units;
    machine.slots = config.rtu.ray_slots;
    machine.stack_entries = config.rtu.stack_entries;
    machine.mailbox_entries = config.rtu.mailbox.entries;
    machine.cache = {config.l1.size_bytes / config.l1.line_bytes / config.l1.ways,
                     config.l1.ways,
                     config.l1.banks,
                     config.l1.mshrs,
                     config.l1.targets_per_mshr,
                     config.l1.latency_cycles};
    machine.memory = {config.memory.latency_cycles, config.memory.bytes_per_cycle};
    return machine;
}

}  // namespace

ReferenceMachine rtl_reference(const std::optional<WaveWindow>& waves) {
    std::optional<rtl::Waves> wanted;
    if (waves) wanted = rtl::Waves{waves->file, waves->first_cycle, waves->end_cycle};
    return [wanted](const sim::Config& config, const model::MemoryImage& image,
                    std::span<const model::Ray> rays, model::RayKind kind) {
        check_is_rtl_machine(config);
        rtl::RtlResult result =
            rtl::run_rtl(image, rays, kind, rtl_config(config), wanted ? &*wanted : nullptr);
        return ReferenceResult{result.cycles, result.counts, result.spilled_entries, std::move(result.hits)};
    };
}
#else
ReferenceMachine rtl_reference(const std::optional<WaveWindow>& /*waves*/) {
    throw Error("this rtusim was built without the RTL reference; install Verilator and build again");
}
#endif

}  // namespace rtu::study
