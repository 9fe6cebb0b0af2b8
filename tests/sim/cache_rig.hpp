#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mock_units.hpp"
#include "sim/cache.hpp"
#include "sim/kernel.hpp"

namespace rtu::test {

using sim::MemoryReply;
using sim::MemoryRequest;
using Script = std::vector<Stamped<MemoryRequest>>;

struct CacheSetup {
    sim::Config::Cache config{};
    std::vector<Script> scripts{};  ///< [input]
    std::size_t reply_count = 1;
    std::uint32_t memory_latency_cycles = 50;
    std::size_t channel_depth = 16;
    std::function<bool(Cycle)> is_sink_open{};
    sim::ClockMode mode = sim::ClockMode::Fast;
    bool is_reversed = false;  ///< units are built, and so ticked, in the opposite order
};

struct CacheOutcome {
    Cycle cycles = 0;
    std::vector<std::vector<Cycle>> pushed;                   ///< [input][request]
    std::vector<std::vector<Stamped<MemoryReply>>> received;  ///< [reply channel]
    std::vector<Stamped<MemoryRequest>> below;                ///< what the memory saw
    sim::CacheCounters counters;
    sim::CycleAccount account;
    friend bool operator==(const CacheOutcome&, const CacheOutcome&) = default;
};

/// Four sets of two ways, line 128, sector 32, two banks.
inline sim::Config::Cache small_cache() {
    return {.size_bytes = 1024,
            .line_bytes = 128,
            .sector_bytes = 32,
            .ways = 2,
            .banks = 2,
            .mshrs = 4,
            .targets_per_mshr = 4,
            .latency_cycles = 7};
}

inline MemoryRequest read(std::uint64_t address, std::uint32_t size_bytes = 32, std::uint32_t tag = 0,
                          std::uint8_t source = 0) {
    return {address, size_bytes, tag, source, false};
}
inline MemoryRequest write(std::uint64_t address, std::uint32_t size_bytes = 32) {
    return {address, size_bytes, 0, 0, true};
}

/// A cache between mock units: a source for each script, a sink for each reply channel, a memory below.
class CacheRig {
  public:
    explicit CacheRig(const CacheSetup& setup) : setup_(setup), clock_("clock", setup.mode, 100'000) {
        for (std::size_t i = 0; i < setup.scripts.size(); ++i) {
            requests_.push_back(channel<MemoryRequest>("requests", i));
        }
        for (std::size_t i = 0; i < setup.reply_count; ++i) {
            replies_.push_back(channel<MemoryReply>("replies", i));
        }
        std::vector<std::function<void()>> steps{[this] { build_sources(); }, [this] { build_cache(); },
                                                 [this] { build_memory(); }, [this] { build_sinks(); }};
        if (setup.is_reversed) std::ranges::reverse(steps);
        for (const auto& build : steps) build();
    }

    /// Runs until `is_done`; by default until every read is answered and nothing moves any more.
    CacheOutcome run(std::function<bool()> is_done = {}) {
        CacheOutcome outcome;
        outcome.cycles = clock_.run(is_done ? std::move(is_done) : [this] { return has_finished(); });
        for (const auto& source : sources_) outcome.pushed.push_back(source->pushed());
        for (const auto& sink : sinks_) outcome.received.push_back(sink->received());
        outcome.below = memory_->requests();
        outcome.counters = cache_->counters();
        outcome.account = cache_->cycle_account();
        return outcome;
    }
    [[nodiscard]] const sim::Cache& cache() const { return *cache_; }

  private:
    static std::string numbered(const char* name, std::size_t number) {
        return fmt::format("{}{}", name, number);
    }
    template <class T>
    std::unique_ptr<Fifo<T>> channel(const char* name, std::size_t number) {
        return std::make_unique<Fifo<T>>(numbered(name, number).c_str(), setup_.channel_depth, clock_);
    }
    void build_sources() {
        for (std::size_t i = 0; i < requests_.size(); ++i) {
            sources_.push_back(std::make_unique<MockSource<MemoryRequest>>(numbered("source", i).c_str(),
                                                                           clock_, setup_.scripts[i]));
            sources_[i]->out(*requests_[i]);
        }
    }
    void build_cache() {
        cache_ = std::make_unique<sim::Cache>("cache", clock_, setup_.config, requests_.size(),
                                              replies_.size(), std::uint8_t{0});
        for (std::size_t i = 0; i < requests_.size(); ++i) cache_->requests_in[i](*requests_[i]);
        for (std::size_t i = 0; i < replies_.size(); ++i) cache_->replies_out[i](*replies_[i]);
        cache_->below_out(below_);
        cache_->fills_in(fills_);
    }
    void build_memory() {
        memory_ = std::make_unique<MockMemory>("memory", clock_, setup_.memory_latency_cycles);
        memory_->in(below_);
        memory_->out(fills_);
    }
    void build_sinks() {
        for (std::size_t i = 0; i < replies_.size(); ++i) {
            sinks_.push_back(std::make_unique<MockSink<MemoryReply>>(numbered("sink", i).c_str(), clock_,
                                                                     setup_.is_sink_open));
            sinks_[i]->in(*replies_[i]);
        }
    }
    [[nodiscard]] bool has_finished() const {
        std::size_t asked = 0, answered = 0;
        for (const Script& script : setup_.scripts) {
            asked += std::size_t(
                std::ranges::count_if(script, [](const auto& request) { return !request.item.is_write; }));
        }
        for (const auto& sink : sinks_) answered += sink->received().size();
        return answered >= asked && below_.size() == 0 && cache_->next_event(0) == no_cycle &&
               std::ranges::all_of(sources_, [](const auto& source) { return source->is_done(); }) &&
               std::ranges::all_of(requests_, [](const auto& requests) { return requests->size() == 0; });
    }

    CacheSetup setup_;
    ClockDomain clock_;
    Fifo<MemoryRequest> below_{"below", setup_.channel_depth, clock_};
    Fifo<MemoryReply> fills_{"fills", setup_.channel_depth, clock_};
    std::vector<std::unique_ptr<Fifo<MemoryRequest>>> requests_;
    std::vector<std::unique_ptr<Fifo<MemoryReply>>> replies_;
    std::vector<std::unique_ptr<MockSource<MemoryRequest>>> sources_;
    std::vector<std::unique_ptr<MockSink<MemoryReply>>> sinks_;
    std::unique_ptr<sim::Cache> cache_;
    std::unique_ptr<MockMemory> memory_;
};

/// Runs the scripts to their end and checks that nothing was lost.
inline CacheOutcome run(const CacheSetup& setup) {
    sim::start_fresh_kernel();
    CacheRig rig(setup);
    CacheOutcome outcome = rig.run();
    rig.cache().check_drained();
    return outcome;
}

}  // namespace rtu::test
