#include "sim/stream_unit.hpp"

#include <algorithm>

#include "model/aabb.hpp"
#include "model/error.hpp"

namespace rtu::sim {

StreamUnit::StreamUnit(sc_core::sc_module_name name, ClockDomain& domain, const Config& config,
                       const StreamJob& job, const StreamPlan& plan)
    : ClockedUnit(name, domain),
      config_(config.rtu.pair),
      memory_bytes_per_cycle_(std::uint64_t(config.dram.channels) * config.dram.bytes_per_cycle),
      job_(job),
      plan_(plan),
      testers_(std::size_t(config.rtu.count) * config.rtu.pair.testers) {
    model::Aabb bounds;
    for (const model::LeafPair& pair : job.pairs) {
        for (const model::Vec3& vertex : pair.vertices) bounds.extend(vertex);
    }
    for (const model::Ray& ray : job.rays) {
        setups_.push_back(model::can_hit(ray) ? std::optional(model::make_ray_setup(ray, bounds))
                                              : std::nullopt);
        closest_.push_back({{.t = ray.t_max}});
    }
}

std::vector<std::optional<model::Hit>> StreamUnit::hits() const {
    std::vector<std::optional<model::Hit>> result;
    for (const model::Closest& c : closest_)
        result.push_back(c.is_found ? std::optional(c.hit) : std::nullopt);
    return result;
}

Cycle StreamUnit::next_event(Cycle now) const {
    Cycle next = no_cycle;
    if (free_at_ > now || !waiting_.empty()) next = std::max(free_at_, now + 1);
    if (!finishing_.empty()) next = std::min(next, std::max(finishing_.front(), now + 1));
    return next;
}

std::string StreamUnit::describe() const {
    return fmt::format("{} batches waiting, {} in the testers", waiting_.size(), finishing_.size());
}

Activity StreamUnit::tick(Cycle now) {
    if (!finishing_.empty() && finishing_.front() <= now && finished_out->can_push(now)) {
        finishing_.pop_front();
        finished_out->push(now, {1});
    }
    while (batches_in->can_pop(now)) waiting_.push_back(batches_in->pop(now).batch);
    if (free_at_ <= now && !waiting_.empty()) {
        begin_batch(now, plan_.batch(waiting_.front()));
        waiting_.pop_front();
    }
    return between_events(now);
}

Activity StreamUnit::between_events(Cycle now) const {
    return free_at_ > now ? Activity::Busy : Activity::Waiting;
}

// Rays within pairs: a pair is read once and meets all rays.
void StreamUnit::begin_batch(Cycle now, const StreamBatch& batch) {
    batch_far_bytes_ = 0;
    const std::uint32_t ray_far = batch.is_ray_far ? ray_bytes : 0;
    const auto pair_far = [&](const model::LeafPair& pair) {
        return batch.is_pair_far ? operand_bytes(pair) : 0;
    };
    if (batch.list) {
        for (std::uint64_t i = batch.list->first; i < batch.list->second; ++i) {
            const model::LeafPair& pair = job_.pairs[i % job_.pairs.size()];
            place_test(now, i / job_.pairs.size(), pair, ray_far + pair_far(pair));
        }
    } else {
        for (std::uint64_t p = batch.pairs.first; p < batch.pairs.second; ++p) {
            std::uint32_t far = pair_far(job_.pairs[p]);
            for (std::uint64_t ray = batch.rays.first; ray < batch.rays.second; ++ray) {
                place_test(now, ray, job_.pairs[p], far + ray_far);
                far = 0;
            }
        }
    }
    ++counters_.batches;
    counters_.memory_bytes += batch_far_bytes_;
    free_at_ = *std::ranges::max_element(testers_);
    finishing_.push_back(last_result_at_);
}

void StreamUnit::place_test(Cycle begin, std::uint64_t ray, const model::LeafPair& pair,
                            std::uint32_t far_bytes) {
    batch_far_bytes_ += far_bytes;
    const Cycle fetched_at =
        begin + (batch_far_bytes_ + memory_bytes_per_cycle_ - 1) / memory_bytes_per_cycle_;
    const auto tester = std::ranges::min_element(testers_);
    const model::PairVisit visit = test(ray, pair);
    const std::uint32_t held = issue_cycles(visit);
    *tester = std::max(*tester, fetched_at) + held;
    last_result_at_ = std::max(last_result_at_, *tester - config_.ii_cycles + config_.latency_cycles);
    counters_.tester_cycles += held;
}

model::PairVisit StreamUnit::test(std::uint64_t ray, const model::LeafPair& pair) {
    model::PairVisit visit{.triangle_tests = pair.has_second() ? 2U : 1U};
    if (setups_[ray]) visit = model::visit_pair(closest_[ray], pair, *setups_[ray]);
    ++counters_.pair_tests;
    counters_.triangle_tests += visit.triangle_tests;
    counters_.exact_tests += visit.exact_tests;
    counters_.replays += is_replayed(visit) ? 1 : 0;
    return visit;
}

bool StreamUnit::is_replayed(const model::PairVisit& visit) const {
    return config_.mode == PairMode::DualShared && visit.exact_tests == 2;
}

std::uint32_t StreamUnit::issue_cycles(const model::PairVisit& visit) const {
    const std::uint32_t issues = config_.mode == PairMode::Single ? visit.triangle_tests : 1;
    return issues * config_.ii_cycles + (is_replayed(visit) ? config_.replay_cycles : 0);
}

void StreamUnit::check_drained() const {
    const std::uint64_t all = std::uint64_t(job_.rays.size()) * job_.pairs.size();
    RTU_CHECK(counters_.pair_tests == all && counters_.batches == plan_.batch_count(),
              "{}: {} of {} tests done in {} of {} batches", name(), counters_.pair_tests, all,
              counters_.batches, plan_.batch_count());
    RTU_CHECK(waiting_.empty() && finishing_.empty(), "{}: batches are left", name());
}

}  // namespace rtu::sim
