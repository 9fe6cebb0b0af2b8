#include "sim/stream_machine.hpp"

#include "model/error.hpp"
#include "sim/kernel.hpp"
#include "sim/linked_host.hpp"

namespace rtu::sim {
namespace {

// The call of a direct test returns with its result.
Config config_of(const Config& config, const StreamJob& job) {
    Config result = config;
    if (job.mode == StreamMode::Direct) result.link.buffers = 1;
    return result;
}

// Nothing moves in a channel while a batch is on the wire or in the testers.
Cycle watchdog_cycles(const Config& config, const StreamPlan& plan) {
    const Config::Rtu::Pair& pair = config.rtu.pair;
    const std::uint64_t test_cycles = 2 * std::uint64_t(pair.ii_cycles) + pair.replay_cycles;
    return config.watchdog_cycles + transfer_cycles(config, plan.most_bytes()) + pair.latency_cycles +
           plan.most_tests() * test_cycles + plan.most_bytes();
}

class StreamMachine {
  public:
    StreamMachine(const Config& config, const StreamJob& job, ClockMode mode)
        : plan_(job),
          domain_("domain", mode, watchdog_cycles(config, plan_)),
          host_("host_side", domain_, config, plan_),
          unit_("testers", domain_, config, job, plan_) {
        unit_.batches_in(host_.arrivals);
        unit_.finished_out(host_.finished);
    }

    StreamResult run() {
        StreamResult result;
        result.cycles = domain_.run([this] { return host_.is_done(); });
        unit_.check_drained();
        result.time = host_.check_drained(result.cycles);
        result.batch_count = host_.batch_count();
        result.hits = unit_.hits();
        result.tests = unit_.counters();
        result.link = host_.counters();
        result.units = host_.results(result.time);
        result.units.push_back(
            {"testers", unit_.cycle_account(), counter_values(stream_counter_rows, unit_.counters())});
        for (const UnitResult& unit : result.units) {
            RTU_CHECK(unit.cycles.total() == result.cycles, "{}: {} cycles accounted for, {} simulated",
                      unit.name, unit.cycles.total(), result.cycles);
        }
        return result;
    }

  private:
    StreamPlan plan_;
    ClockDomain domain_;
    LinkedHost host_;
    StreamUnit unit_;
};

}  // namespace

StreamResult simulate_stream(const Config& config, const StreamJob& job, ClockMode mode) {
    start_fresh_kernel();
    return StreamMachine(config_of(config, job), job, mode).run();
}

}  // namespace rtu::sim
