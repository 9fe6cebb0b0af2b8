#include "study/stream/stream_balance.hpp"

#include <algorithm>

namespace rtu::study {

namespace {

// Direct tests come one by one, whatever the buffers.
std::uint32_t buffers(const sim::Config& config, const sim::StreamJob& job) {
    return job.mode == sim::StreamMode::Direct ? 1 : config.link.buffers;
}

}  // namespace

double BatchTimes::link(const sim::Config::Link& config) const {
    if (config.buffers == 1) return host + upload + read_back + latency;
    const double wires = config.wires == 1 ? upload + read_back : std::max(upload, read_back);
    return std::max(host, wires);
}

double BatchTimes::period(const sim::Config::Link& config) const {
    const double alone = host + upload + read_back + latency + machine;
    return std::max({link(config), machine, alone / config.buffers});
}

BatchTimes batch_times(const sim::Config& config, const sim::StreamJob& job, double test_cycles) {
    const sim::StreamPlan plan(job);
    const double batches = double(plan.batch_count()), mhz = config.clock_mhz;
    const double transfers = plan.total_down_bytes() > 0 ? 2 : 1;
    BatchTimes times;
    times.host = transfers * config.link.overhead_ns * mhz / 1000;
    times.latency = transfers * config.link.latency_ns * mhz / 1000;
    times.upload = double(plan.total_up_bytes()) * mhz / config.link.up_mb_per_second / batches;
    times.read_back = double(plan.total_down_bytes()) * mhz / config.link.down_mb_per_second / batches;
    times.machine = test_cycles * double(job.rays.size()) * double(job.pairs.size()) / batches;
    return times;
}

std::optional<std::uint64_t> balance_batch(const sim::Config& config, const sim::StreamJob& job,
                                           double test_cycles) {
    sim::Config::Link link = config.link;
    link.buffers = buffers(config, job);
    const auto is_balanced = [&](std::uint64_t batch_tests) {
        sim::StreamJob other = job;
        other.batch_tests = batch_tests;
        const BatchTimes times = batch_times(config, other, test_cycles);
        return times.machine >= times.link(link);
    };
    std::uint64_t most = std::uint64_t(job.rays.size()) * job.pairs.size();
    if (job.mode == sim::StreamMode::Direct) most = 1;
    if (!is_balanced(most)) return std::nullopt;
    std::uint64_t too_few = 0;
    while (most - too_few > 1) {
        const std::uint64_t middle = too_few + (most - too_few) / 2;
        (is_balanced(middle) ? most : too_few) = middle;
    }
    return most;
}

}  // namespace rtu::study
