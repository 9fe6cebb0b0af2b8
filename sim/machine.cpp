#include "sim/machine.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>

#include "sim/kernel.hpp"
#include "sim/linked_host.hpp"
#include "sim/machine_observer.hpp"
#include "sim/memory_boundary.hpp"
#include "sim/memory_counters.hpp"
#include "sim/ray_batches.hpp"
#include "sim/ray_source.hpp"
#include "sim/rtu.hpp"
#include "sim/shared_memory.hpp"

namespace rtu::sim {

namespace {

// Each RTU's stacks lie behind those of the RTUs before it.
model::StackRegion stack_region(const Config& config, const model::MemoryImage& image, std::uint32_t rtu) {
    model::StackRegion region = model::stack_region(image, config.rtu.stack_entries, config.l1.line_bytes);
    region.base_address += std::uint64_t(rtu) * config.rtu.ray_slots * region.slot_bytes;
    return region;
}

void add_channels(const std::vector<sc_core::sc_object*>& objects, std::vector<NamedChannel>& channels) {
    for (const sc_core::sc_object* object : objects) {
        if (const auto* channel = dynamic_cast<const ChannelView*>(object)) {
            channels.push_back({object->name(), channel});
        }
        add_channels(object->get_child_objects(), channels);
    }
}

// The mailboxes in memory lie behind all stacks, those of an RTU behind those of the RTUs before it.
MailboxRegion mailbox_region(const Config& config, const model::MemoryImage& image, std::uint32_t rtu) {
    constexpr std::uint64_t page_bytes = 4096;
    const auto in_whole = [](std::uint64_t value, std::uint64_t unit) {
        return (value + unit - 1) / unit * unit;
    };
    const model::StackRegion stacks = stack_region(config, image, config.rtu.count);  // of none: their end
    const std::uint64_t slot_bytes = in_whole(image.pair_count * mailbox_word_bytes, config.l1.line_bytes);
    return {
        in_whole(stacks.base_address, page_bytes) + std::uint64_t(rtu) * config.rtu.ray_slots * slot_bytes,
        slot_bytes, image.node_count * image.node_bytes()};
}

// What a scheduler's report has more where leaves are looked up.
bool has_mailbox_counters(const Config& config) {
    return config.bvh.splits == SplitKind::Spatial || config.rtu.mailbox.is_on();
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
          memory_(make_shared_memory(config, domain_)) {
        for (std::uint32_t i = 0; i < config.rtu.count; ++i) {
            add_rtu(i, {image, kind, stack_region(config, image, i), mailbox_region(config, image, i)},
                    std::as_bytes(std::span(image.blocks)));
        }
        if (batches == nullptr) return;
        host_ = std::make_unique<LinkedHost>("host_side", domain_, config, *batches);
        source_.arrivals_in(host_->arrivals);
        sink_.finished_out(host_->finished);
    }

    void observe(MachineObserver& observer) {
        MachineView view{domain_, {}, {}};
        add_channels(sc_core::sc_get_top_level_objects(), view.channels);
        for (const auto& node : nodes_) view.rtus.push_back({node->rtu, node->requests});
        observer.attach(view);
        domain_.observe(observer);
    }

    MachineResult run(const SimulationProgress& progress) {
        MachineResult result;
        const auto tell = [&] {
            if (progress) progress(source_.share());
        };
        advance([] { return false; }, tell);
        result.cycles = cycles_;
        result.ray_count = source_.ray_count();
        collect(result);
        check(result);
        return result;
    }

    void advance_to(std::uint64_t count) {
        const auto is_there = [this, count] { return source_.ray_count() >= count; };
        if (!is_there()) advance(is_there, {});
    }

    [[nodiscard]] MachineMark mark() const {
        MachineMark mark{.cycles = cycles_, .rays = source_.ray_count(), .counts = {}};
        for (const auto& node : nodes_) {
            const Rtu& rtu = node->rtu;
            mark.counts += counts_of(rtu);
            mark.leaf_visits += rtu.pair.counters().leaf_visits;
            mark.l1_misses += rtu.l1.counters().misses;
        }
        mark.l2_misses = memory_->l2_misses();
        return mark;
    }

    void warm(std::uint32_t rtu, std::uint64_t address, std::uint32_t size_bytes) {
        nodes_[rtu]->rtu.l1.warm(address, size_bytes, [this](std::uint64_t first, std::uint32_t bytes) {
            memory_->warm(first, bytes);
        });
    }

  private:
    // Until all rays have returned, or `is_there()`. The run cannot end before its first cycle, so a
    // workload without rays gets none.
    void advance(const std::function<bool()>& is_there, const std::function<void()>& tell) {
        const auto is_done = [this] {
            return source_.is_done() && sink_.received() == source_.ray_count() &&
                   (!host_ || host_->is_done());
        };
        if (is_done()) return;
        cycles_ = domain_.run([&] { return is_there() || is_done(); }, tell);
    }

    static model::TraversalCounts counts_of(const Rtu& rtu) {
        return {rtu.box.counters().node_visits,        rtu.box.counters().box_tests,
                rtu.pair.counters().pair_tests,        rtu.pair.counters().triangle_tests,
                rtu.scheduler.mailbox_counters().hits, rtu.scheduler.mailbox_counters().duplicates};
    }

    // An RTU, and its way to the shared memory and back.
    struct Node {
        Node(const std::string& name, ClockDomain& domain, const Config& config, std::uint32_t index,
             const RtuJob& job, std::span<const std::byte> image)
            : rtu(name.c_str(), domain, config, index, job),
              initiator((name + "_initiator").c_str()),
              target((name + "_target").c_str(), image),
              requests((name + "_requests").c_str(), request_depth(config), domain) {}
        Rtu rtu;
        BoundaryInitiator initiator;
        BoundaryTarget target;
        Fifo<MemoryRequest> requests;
    };

    void add_rtu(std::uint32_t index, const RtuJob& job, std::span<const std::byte> image) {
        auto& node = *nodes_.emplace_back(
            std::make_unique<Node>(fmt::format("rtu{}", index), domain_, config_, index, job, image));
        source_.rays_out[index](node.rtu.rays_in);
        sink_.hits_in[index](node.rtu.hits_out);
        node.rtu.l1.below_out(node.initiator);
        node.initiator.replies_out(node.rtu.fills_in);
        node.target.requests_out(node.requests);
        memory_->connect(index, node.requests, node.target);
        connect(node.initiator, node.target);
    }

    void collect(MachineResult& result) const {
        if (host_) result.units = host_->results(host_->check_drained(result.cycles));
        result.units.push_back({"ray_source", source_.cycle_account(), {}});
        for (const auto& node : nodes_) {
            const Rtu& rtu = node->rtu;
            const std::string prefix = nodes_.size() > 1 ? std::string(rtu.name()) + "." : "";
            result.units.push_back({prefix + "scheduler", rtu.scheduler.cycle_account(),
                                    counter_values(scheduler_counter_rows, rtu.scheduler.counters())});
            if (has_mailbox_counters(config_)) {
                std::ranges::move(counter_values(mailbox_counter_rows, rtu.scheduler.mailbox_counters()),
                                  std::back_inserter(result.units.back().counters));
            }
            result.units.push_back({prefix + "box", rtu.box.cycle_account(),
                                    counter_values(box_counter_rows, rtu.box.counters())});
            result.units.push_back({prefix + "pair", rtu.pair.cycle_account(),
                                    counter_values(pair_counter_rows, rtu.pair.counters())});
            result.memory.push_back({prefix + "l1", rtu.l1.cycle_account(),
                                     counter_values(cache_counter_rows, rtu.l1.counters())});
            result.counts += counts_of(rtu);
        }
        result.units.push_back({"hit_sink", sink_.cycle_account(), {}});
        std::ranges::move(memory_->results(), std::back_inserter(result.memory));
    }

    void check(const MachineResult& result) const {
        std::uint64_t finished = 0;
        for (const auto& node : nodes_) {
            node->rtu.check_drained();
            finished += node->rtu.scheduler.counters().rays_finished;
        }
        RTU_CHECK(finished == result.ray_count && sink_.received() == finished,
                  "{} rays in, {} finished, {} out", result.ray_count, finished, sink_.received());
        memory_->check_drained();
        for (const auto* units : {&result.units, &result.memory}) {
            for (const UnitResult& unit : *units) {
                RTU_CHECK(unit.cycles.total() == result.cycles, "{}: {} cycles accounted for, {} simulated",
                          unit.name, unit.cycles.total(), result.cycles);
            }
        }
    }

    // An L2 takes what an L1 can have outstanding; a flat memory is the last level.
    static std::size_t request_depth(const Config& config) {
        return config.memory.model == MemoryModel::Flat ? memory_request_depth : config.l1.mshrs;
    }

    Config config_;
    ClockDomain domain_;
    RaySource source_;
    HitSink sink_;
    std::vector<std::unique_ptr<Node>> nodes_;
    std::unique_ptr<LinkedHost> host_;  // only with a link
    std::unique_ptr<SharedMemory> memory_;
    Cycle cycles_ = 0;
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

MachineResult simulate_observed(const Config& config, const model::MemoryImage& image, RaySupply& rays,
                                model::RayKind kind, const HitConsumer& on_hit, MachineObserver& observer,
                                ClockMode mode) {
    start_fresh_kernel();
    std::optional<RayBatches> batches;
    if (config.link.count > 0) batches.emplace(rays, config.link.batch_rays);
    RaySupply& supply = batches ? static_cast<RaySupply&>(*batches) : rays;
    Machine machine(config, image, supply, batches ? &*batches : nullptr, kind, on_hit, mode);
    machine.observe(observer);
    return machine.run({});
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

class MachineSession::Parts {
  public:
    Parts(const Config& config, const model::MemoryImage& image, RaySupply& rays, model::RayKind kind)
        : machine(
              config, image, rays, nullptr, kind, [](const std::optional<model::Hit>&) {}, ClockMode::Fast) {}
    Machine machine;
};

MachineSession::MachineSession(const Config& config, const model::MemoryImage& image, RaySupply& rays,
                               model::RayKind kind) {
    start_fresh_kernel();
    parts_ = std::make_unique<Parts>(config, image, rays, kind);
}

MachineSession::~MachineSession() = default;

void MachineSession::advance_to(std::uint64_t count) { parts_->machine.advance_to(count); }

void MachineSession::finish() { static_cast<void>(parts_->machine.run({})); }

MachineMark MachineSession::mark() const { return parts_->machine.mark(); }

void MachineSession::warm(std::uint32_t rtu, std::uint64_t address, std::uint32_t size_bytes) {
    parts_->machine.warm(rtu, address, size_bytes);
}

}  // namespace rtu::sim
