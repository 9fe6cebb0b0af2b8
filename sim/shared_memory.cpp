#include "sim/shared_memory.hpp"

#include "sim/cache.hpp"
#include "sim/dram.hpp"
#include "sim/flat_memory.hpp"

namespace rtu::sim {
namespace {

class L2AndDram final : public SharedMemory {
  public:
    L2AndDram(const Config& config, ClockDomain& domain)
        : l2_("l2", domain, config.l2, config.rtu.count, config.rtu.count, 0),
          dram_("dram", domain, config.dram, config.l2.line_bytes),
          dram_requests_("dram_requests", memory_request_depth, domain),
          dram_replies_("dram_replies", config.l2.mshrs, domain) {
        l2_.below_out(dram_requests_);
        l2_.fills_in(dram_replies_);
        dram_.requests_in(dram_requests_);
        dram_.replies_out(dram_replies_);
    }

    void connect(std::size_t index, Fifo<MemoryRequest>& requests, PushIf<MemoryReply>& replies) override {
        l2_.requests_in[index](requests);
        l2_.replies_out[index](replies);
    }
    void warm(std::uint64_t address, std::uint32_t size_bytes) override {
        l2_.warm(address, size_bytes, [](std::uint64_t, std::uint32_t) {});
    }
    [[nodiscard]] std::uint64_t l2_misses() const override { return l2_.counters().misses; }
    [[nodiscard]] std::vector<UnitResult> results() const override {
        return {{"l2", l2_.cycle_account(), counter_values(cache_counter_rows, l2_.counters())},
                {"dram", dram_.cycle_account(), counter_values(dram_counter_rows, dram_.counters())}};
    }
    void check_drained() const override {
        l2_.check_drained();
        dram_.check_drained();
    }

  private:
    Cache l2_;
    Dram dram_;
    Fifo<MemoryRequest> dram_requests_;
    Fifo<MemoryReply> dram_replies_;
};

class OnlyFlatMemory final : public SharedMemory {
  public:
    OnlyFlatMemory(const Config& config, ClockDomain& domain)
        : memory_("memory", domain, config.memory, config.rtu.count) {}

    void connect(std::size_t index, Fifo<MemoryRequest>& requests, PushIf<MemoryReply>& replies) override {
        memory_.requests_in[index](requests);
        memory_.replies_out[index](replies);
    }
    void warm(std::uint64_t, std::uint32_t) override {}
    [[nodiscard]] std::uint64_t l2_misses() const override { return 0; }
    [[nodiscard]] std::vector<UnitResult> results() const override {
        return {{"memory", memory_.cycle_account(),
                 counter_values(flat_memory_counter_rows, memory_.counters())}};
    }
    void check_drained() const override { memory_.check_drained(); }

  private:
    FlatMemory memory_;
};

}  // namespace

std::unique_ptr<SharedMemory> make_shared_memory(const Config& config, ClockDomain& domain) {
    if (config.memory.model == MemoryModel::Flat) return std::make_unique<OnlyFlatMemory>(config, domain);
    return std::make_unique<L2AndDram>(config, domain);
}

}  // namespace rtu::sim
