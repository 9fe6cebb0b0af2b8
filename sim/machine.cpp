#include "sim/machine.hpp"

#include <cstddef>
#include <memory>
#include <utility>

#include "sim/dram.hpp"
#include "sim/kernel.hpp"
#include "sim/linked_host.hpp"
#include "sim/memory_boundary.hpp"
#include "sim/memory_counters.hpp"
#include "sim/ray_batches.hpp"
#include "sim/ray_source.hpp"
#include "sim/rtu.hpp"

namespace rtu::sim {

namespace {

constexpr std::uint64_t page_bytes = 4096;

std::uint64_t round_up(std::uint64_t value, std::uint64_t to) { return (value + to - 1) / to * to; }

// Each RTU's stacks lie behind the image, a whole number of lines a slot.
StackRegion stack_region(const Config& config, const model::MemoryImage& image, std::uint32_t rtu) {
    const std::uint64_t slot_bytes = round_up(
        (model::stack_capacity(image) + spill_block_entries) * stack_entry_bytes, config.l1.line_bytes);
    const std::uint64_t first_slot = std::uint64_t(rtu) * config.rtu.ray_slots;
    return {round_up(image.size_bytes(), page_bytes) + first_slot * slot_bytes, slot_bytes};
}

// A transfer may take longer than anything within the machine.
Cycle watchdog_cycles(const Config& config) {
    const std::uint64_t batch_bytes = std::uint64_t(config.link.batch_rays) * ray_bytes;
    return config.watchdog_cycles + (config.link.count > 0 ? transfer_cycles(config, batch_bytes) : 0);
}

// All RTUs, the memory that they share, and the two ends that rays come from and go to.
class Machine {
  public:
    // `batches`: the same rays as a host sends them, or none without a link.
    Machine(const Config& config, const model::MemoryImage& image, RaySupply& rays, BatchSupply* batches,
            model::RayKind kind, const HitConsumer& on_hit, ClockMode mode)
        : config_(config),
          domain_("domain", mode, watchdog_cycles(config)),
          source_("ray_source", domain_, rays, config.host.rays_per_cycle, config.rtu.count),
          sink_("hit_sink", domain_, on_hit, config.rtu.count),
          l2_("l2", domain_, config.l2, config.rtu.count, config.rtu.count, 0),
          dram_("dram", domain_, config.dram, config.l2.line_bytes),
          dram_requests_("dram_requests", dram_request_depth, domain_),
          dram_replies_("dram_replies", config.l2.mshrs, domain_) {
        for (std::uint32_t i = 0; i < config.rtu.count; ++i) {
            add_rtu(i, {image, kind, stack_region(config, image, i)}, std::as_bytes(std::span(image.blocks)));
        }
        l2_.below_out(dram_requests_);
        l2_.fills_in(dram_replies_);
        dram_.requests_in(dram_requests_);
        dram_.replies_out(dram_replies_);
        if (batches == nullptr) return;
        host_ = std::make_unique<LinkedHost>("host_side", domain_, config, *batches);
        source_.arrivals_in(host_->arrivals);
        sink_.finished_out(host_->finished);
    }

    MachineResult run(const SimulationProgress& progress) {
        MachineResult result;
        const auto tell = [&] {
            if (progress) progress(source_.share());
        };
        // The run cannot end before its first cycle, so a workload without rays gets none.
        const auto is_done = [this] {
            return source_.is_done() && sink_.received() == source_.ray_count() &&
                   (!host_ || host_->is_done());
        };
        if (!source_.is_done()) result.cycles = domain_.run(is_done, tell);
        result.ray_count = source_.ray_count();
        collect(result);
        check(result);
        return result;
    }

  private:
    // An RTU, and its way to the L2 and back.
    struct Node {
        Node(const std::string& name, ClockDomain& domain, const Config& config, std::uint32_t index,
             const RtuJob& job, std::span<const std::byte> image)
            : rtu(name.c_str(), domain, config, index, job),
              initiator((name + "_initiator").c_str()),
              target((name + "_target").c_str(), image),
              l2_requests((name + "_l2_requests").c_str(), config.l1.mshrs, domain) {}
        Rtu rtu;
        BoundaryInitiator initiator;
        BoundaryTarget target;
        Fifo<MemoryRequest> l2_requests;
    };

    void add_rtu(std::uint32_t index, const RtuJob& job, std::span<const std::byte> image) {
        auto& node = *nodes_.emplace_back(
            std::make_unique<Node>(fmt::format("rtu{}", index), domain_, config_, index, job, image));
        source_.rays_out[index](node.rtu.rays_in);
        sink_.hits_in[index](node.rtu.hits_out);
        node.rtu.l1.below_out(node.initiator);
        node.initiator.replies_out(node.rtu.fills_in);
        node.target.requests_out(node.l2_requests);
        l2_.requests_in[index](node.l2_requests);
        l2_.replies_out[index](node.target);
        connect(node.initiator, node.target);
    }

    void collect(MachineResult& result) const {
        if (host_) result.units = host_->results(host_->check_drained(result.cycles));
        result.units.push_back({"ray_source", source_.cycle_account(), {}});
        for (const auto& node : nodes_) {
            const Rtu& rtu = node->rtu;
            const std::string prefix = nodes_.size() > 1 ? std::string(rtu.name()) + "." : "";
            result.units.push_back({prefix + "scheduler", rtu.scheduler.cycle_account(),
                                    values(scheduler_counter_rows, rtu.scheduler.counters())});
            result.units.push_back(
                {prefix + "box", rtu.box.cycle_account(), values(box_counter_rows, rtu.box.counters())});
            result.units.push_back(
                {prefix + "pair", rtu.pair.cycle_account(), values(pair_counter_rows, rtu.pair.counters())});
            result.memory.push_back(
                {prefix + "l1", rtu.l1.cycle_account(), values(cache_counter_rows, rtu.l1.counters())});
            result.counts += {rtu.box.counters().node_visits, rtu.box.counters().box_tests,
                              rtu.pair.counters().pair_tests, rtu.pair.counters().triangle_tests};
        }
        result.units.push_back({"hit_sink", sink_.cycle_account(), {}});
        result.memory.push_back({"l2", l2_.cycle_account(), values(cache_counter_rows, l2_.counters())});
        result.memory.push_back({"dram", dram_.cycle_account(), values(dram_counter_rows, dram_.counters())});
    }

    void check(const MachineResult& result) const {
        std::uint64_t finished = 0;
        for (const auto& node : nodes_) {
            node->rtu.check_drained();
            finished += node->rtu.scheduler.counters().rays_finished;
        }
        RTU_CHECK(finished == result.ray_count && sink_.received() == finished,
                  "{} rays in, {} finished, {} out", result.ray_count, finished, sink_.received());
        l2_.check_drained();
        dram_.check_drained();
        for (const auto* units : {&result.units, &result.memory}) {
            for (const UnitResult& unit : *units) {
                RTU_CHECK(unit.cycles.total() == result.cycles, "{}: {} cycles accounted for, {} simulated",
                          unit.name, unit.cycles.total(), result.cycles);
            }
        }
    }

    static constexpr std::size_t dram_request_depth = 8;  // several L2 misses and write-backs a cycle

    const Config& config_;
    ClockDomain domain_;
    RaySource source_;
    HitSink sink_;
    std::vector<std::unique_ptr<Node>> nodes_;
    std::unique_ptr<LinkedHost> host_;  // only with a link
    Cache l2_;
    Dram dram_;
    Fifo<MemoryRequest> dram_requests_;
    Fifo<MemoryReply> dram_replies_;
};

}  // namespace

MachineResult simulate(const Config& config, const model::MemoryImage& image, RaySupply& rays,
                       model::RayKind kind, const HitConsumer& on_hit, ClockMode mode,
                       const SimulationProgress& progress) {
    start_fresh_kernel();
    if (config.link.count == 0)
        return Machine(config, image, rays, nullptr, kind, on_hit, mode).run(progress);
    RayBatches batches(rays, config.link.batch_rays);
    return Machine(config, image, batches, &batches, kind, on_hit, mode).run(progress);
}

MachineResult simulate(const Config& config, const model::MemoryImage& image,
                       std::span<const model::Ray> rays, model::RayKind kind, ClockMode mode,
                       const SimulationProgress& progress) {
    SpanSupply supply(rays);
    std::vector<std::optional<model::Hit>> hits;
    hits.reserve(rays.size());
    MachineResult result = simulate(
        config, image, supply, kind, [&hits](const auto& hit) { hits.push_back(hit); }, mode, progress);
    result.hits = std::move(hits);
    return result;
}

}  // namespace rtu::sim
