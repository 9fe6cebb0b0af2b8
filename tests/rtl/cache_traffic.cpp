#include "cache_traffic.hpp"

#include <Vcache.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <string>

#include "rtl_ref/harness/cache_events.hpp"
#include "rtl_ref/harness/clock.hpp"
#include "rtl_ref/harness/flat_memory.hpp"
#include "sim/cache.hpp"
#include "sim/flat_memory.hpp"
#include "sim/kernel.hpp"
#include "vectors.hpp"

namespace rtu::test {

CacheClient::CacheClient(const CacheCase& test_case) : case_(test_case) {
    for (std::uint32_t tag = 0; tag < cache_tags; ++tag) free_tags_.insert(tag);
    std::uint64_t end = 0;
    for (const PlannedRequest& request : case_.plan) {
        end = std::max(end, request.address + request.size_bytes);
    }
    RandomBits random(71);
    initial_.resize((end + 127) / 128 * 128);
    for (std::byte& byte : initial_) byte = std::byte(random.bits());
    memory_ = initial_;
}

const CacheClient::Request* CacheClient::next(Cycle now) {
    if (planned_ == case_.plan.size()) return nullptr;
    const PlannedRequest& planned = case_.plan[planned_];
    if (!is_prepared_ && planned_ == 0) earliest_ = planned.gap_cycles;
    if (now < earliest_) return nullptr;
    if (!is_prepared_) {
        if (planned.is_write ? is_being_read(planned.address / sector_bytes) : free_tags_.empty())
            return nullptr;
        prepare(planned);
    }
    return &request_;
}

void CacheClient::prepare(const PlannedRequest& planned) {
    is_prepared_ = true;
    request_.message = {planned.address, planned.size_bytes, 0, planned.source, planned.is_write};
    if (!planned.is_write) {
        request_.message.tag = *free_tags_.begin();
        return;
    }
    RandomBits random(planned_);
    for (std::byte& byte : request_.data) byte = std::byte(random.bits());
}

void CacheClient::pushed(Cycle now) {
    const sim::MemoryRequest& message = request_.message;
    events_.push_back({now, CacheEvent::Kind::Request, message.source, message.tag});
    const auto begin = memory_.begin() + std::ptrdiff_t(message.address);
    if (message.is_write) {
        std::ranges::copy(request_.data, begin);
    } else {
        const std::uint64_t first = message.address / sector_bytes;
        for (std::uint64_t s = first; s < first + message.size_bytes / sector_bytes; ++s) readers_.insert(s);
        under_way_[message.tag] = {first, message.source, {begin, begin + message.size_bytes}};
        free_tags_.erase(message.tag);
    }
    is_prepared_ = false;
    if (++planned_ < case_.plan.size()) earliest_ = now + case_.plan[planned_].gap_cycles;
}

bool CacheClient::takes(std::uint8_t source, Cycle now) const {
    return !case_.takes || case_.takes(source, now);
}

void CacheClient::reply(Cycle now, std::uint8_t source, std::uint32_t tag, const std::byte* data) {
    events_.push_back({now, CacheEvent::Kind::Reply, source, tag});
    const auto read = under_way_.find(tag);
    ASSERT_TRUE(read != under_way_.end() && read->second.source == source)
        << "cycle " << now << ": a reply to source " << int(source) << ", tag " << tag
        << " that nobody wants";
    const std::vector<std::byte>& expected = read->second.expected;
    if (data != nullptr) {
        EXPECT_EQ(std::memcmp(data, expected.data(), expected.size()), 0)
            << "cycle " << now << ": wrong data of tag " << tag << ", " << expected.size() << " bytes at "
            << read->second.first_sector * sector_bytes;
    }
    for (std::size_t i = 0; i < expected.size() / sector_bytes; ++i) {
        readers_.erase(readers_.find(read->second.first_sector + i));
    }
    under_way_.erase(read);
    free_tags_.insert(tag);
}

Cycle drain_cycles(const CacheCase& test_case) {
    // The fills of the last misses, and all write-backs that may be queued.
    const Cycle line = (128 + test_case.memory.bytes_per_cycle - 1) / test_case.memory.bytes_per_cycle;
    return test_case.memory.latency_cycles + test_case.cache.latency_cycles + 64 * line + 200;
}

namespace {

// A CacheClient in the simulator.
class ClientUnit final : public sim::ClockedUnit {
  public:
    ClientUnit(sc_core::sc_module_name name, sim::ClockDomain& domain, CacheClient& client)
        : ClockedUnit(name, domain), replies_in("replies_in", source_count), client_(client) {}

    sc_core::sc_port<sim::PushIf<sim::MemoryRequest>> requests_out{"requests_out"};
    sc_core::sc_vector<sc_core::sc_port<sim::Fifo<sim::MemoryReply>>> replies_in;

    [[nodiscard]] Cycle next_event(Cycle now) const override { return now + 1; }
    [[nodiscard]] std::string describe() const override { return "a client"; }

  protected:
    sim::Activity tick(Cycle now) override {
        for (std::uint8_t source = 0; source < source_count; ++source) {
            auto& replies = *replies_in[source].operator->();
            if (replies.can_pop(now) && client_.takes(source, now)) {
                client_.reply(now, source, replies.pop(now).tag);
            }
        }
        for (int i = 0; i < 2; ++i) {
            const CacheClient::Request* request = client_.next(now);
            if (request == nullptr || !requests_out->can_push(now)) break;
            requests_out->push(now, request->message);
            client_.pushed(now);
        }
        return sim::Activity::Waiting;
    }

  private:
    CacheClient& client_;
};

template <class T>
std::unique_ptr<sim::Fifo<T>> channel(const char* name, std::size_t depth, sim::ClockDomain& domain) {
    return std::make_unique<sim::Fifo<T>>(name, depth, domain);
}

}  // namespace

CacheRun run_simulated(const CacheCase& test_case) {
    sim::start_fresh_kernel();
    CacheClient client(test_case);
    sim::ClockDomain domain("domain", sim::ClockMode::Fast, 1'000'000);
    // As in an RTU with two fetches a cycle and a flat memory.
    const auto requests = channel<sim::MemoryRequest>("requests", 4, domain);
    const auto below = channel<sim::MemoryRequest>("below", sim::memory_request_depth, domain);
    const auto fills = channel<sim::MemoryReply>("fills", sim::flat_fill_depth, domain);
    std::vector<std::unique_ptr<sim::Fifo<sim::MemoryReply>>> replies;
    ClientUnit unit("client", domain, client);
    sim::Cache cache("cache", domain, test_case.cache, 1, source_count, 0);
    sim::FlatMemory memory("memory", domain, test_case.memory, 1);
    unit.requests_out(*requests);
    cache.requests_in[0](*requests);
    for (std::uint8_t source = 0; source < source_count; ++source) {
        replies.push_back(channel<sim::MemoryReply>(("replies" + std::to_string(source)).c_str(),
                                                    2 * std::size_t(test_case.cache.banks), domain));
        cache.replies_out[source](*replies[source]);
        unit.replies_in[source](*replies[source]);
    }
    cache.below_out(*below);
    cache.fills_in(*fills);
    memory.requests_in[0](*below);
    memory.replies_out[0](*fills);

    Cycle left = drain_cycles(test_case);
    CacheRun run;
    run.cycles = domain.run([&] { return client.is_done() && left-- == 0; });
    cache.check_drained();
    run.events = client.events();
    run.counters = cache.counters();
    run.memory = memory.counters();
    return run;
}

namespace {

constexpr std::uint32_t built_banks = 4;  // the Verilated cache's

// A Verilated cache, its memory and its client.
class VerilatedCache {
  public:
    VerilatedCache(const CacheCase& test_case, CacheClient& client)
        : client_(client),
          unit_(std::make_unique<Vcache>()),
          memory_({test_case.memory.latency_cycles, test_case.memory.bytes_per_cycle},
                  client.initial_memory()) {
        const sim::Config::Cache& config = test_case.cache;
        unit_->set_mask_i = std::uint8_t(config.size_bytes / config.line_bytes / config.ways - 1);
        unit_->last_way_i = std::uint8_t(config.ways - 1);
        unit_->bank_mask_i = std::uint8_t(config.banks - 1);
        unit_->last_mshr_i = std::uint8_t(config.mshrs - 1);
        unit_->last_target_i = std::uint8_t(config.targets_per_mshr - 1);
        unit_->last_latency_i = std::uint8_t(config.latency_cycles - 1);
        unit_->request_valid_i = 0;
        unit_->reply_ready_i = 0;
        unit_->fill_valid_i = 0;
        unit_->mem_ready_i = 0;
        reset();
    }

    void cycle(Cycle now) {
        memory_.offer(*unit_);
        unit_->reply_ready_i = 0;
        for (std::uint8_t source = 0; source < source_count; ++source) take_reply(now, source);
        offer_requests(now);
        rtl::settle(*unit_);
        memory_.finish(*unit_);
        rtl::settle(*unit_);
        events_.add(unit_->events_o, built_banks);
        rtl::clock_edge(*unit_);
        rtl::settle(*unit_);
    }

    [[nodiscard]] sim::CacheCounters counters() const {
        const rtl::CacheEvents& e = events_;
        return {.reads = reads_,
                .replies = replies_,
                .line_reads = e.hits + e.misses + e.mshr_merges,
                .hits = e.hits,
                .misses = e.misses,
                .mshr_merges = e.mshr_merges,
                .line_writes = e.line_writes,
                .evictions = e.evictions,
                .write_backs = e.write_backs,
                .fills = e.fills,
                .bytes_read = bytes_read_,
                .bytes_written = bytes_written_,
                .bytes_from_below = memory_.counters().read_bytes,
                .bytes_to_below = memory_.counters().write_bytes,
                .bank_conflict_cycles = e.bank_conflict_cycles,
                .reply_stall_cycles = e.reply_stall_cycles,
                .pipeline_full_cycles = e.pipeline_full_cycles,
                .mshr_full_cycles = e.mshr_full_cycles,
                .target_full_cycles = e.target_full_cycles,
                .set_full_cycles = e.set_full_cycles,
                .write_back_stall_cycles = e.write_back_stall_cycles,
                .below_full_cycles = e.below_full_cycles};
    }
    [[nodiscard]] const rtl::FlatMemory& memory() const { return memory_; }

  private:
    void reset() {
        unit_->rst_ni = 1;
        rtl::settle(*unit_);
        unit_->rst_ni = 0;
        rtl::settle(*unit_);
        rtl::clock_edge(*unit_);
        unit_->rst_ni = 1;
        rtl::settle(*unit_);
        for (int i = 0; i < 1000 && !unit_->is_ready_o; ++i) {
            rtl::clock_edge(*unit_);
            rtl::settle(*unit_);
        }
        EXPECT_TRUE(unit_->is_ready_o);
    }

    void take_reply(Cycle now, std::uint8_t source) {
        if ((unit_->reply_valid_o >> source & 1U) == 0 || !client_.takes(source, now)) return;
        unit_->reply_ready_i |= std::uint8_t(1U << source);
        const std::uint32_t tag = unit_->reply_tag_o >> (7 * source) & (cache_tags - 1);
        const std::array<const void*, source_count> data{unit_->node_o.data(), unit_->leaf_o.data(),
                                                         unit_->stack_block_o.data()};
        client_.reply(now, source, tag, static_cast<const std::byte*>(data[source]));
        ++replies_;
    }

    void offer_requests(Cycle now) {
        unit_->request_valid_i = 0;
        unit_->request_address_i = 0;
        unit_->request_sectors_i = 0;
        unit_->request_tag_i = 0;
        unit_->request_source_i = 0;
        unit_->request_is_write_i = 0;
        for (std::uint32_t i = 0; i < 2; ++i) {
            const CacheClient::Request* request = client_.next(now);
            if (request == nullptr || (unit_->request_ready_o >> i & 1U) == 0) break;
            const sim::MemoryRequest& message = request->message;
            unit_->request_valid_i |= std::uint8_t(1U << i);
            unit_->request_address_i |= message.address << (32 * i);
            unit_->request_sectors_i |= std::uint8_t(message.size_bytes / sector_bytes << (4 * i));
            unit_->request_tag_i |= std::uint16_t(message.tag << (7 * i));
            unit_->request_source_i |= std::uint8_t(message.source << (2 * i));
            unit_->request_is_write_i |= std::uint8_t((message.is_write ? 1U : 0U) << i);
            std::memcpy(&unit_->request_data_i[8 * i], request->data.data(), sector_bytes);
            if (!message.is_write) ++reads_;
            (message.is_write ? bytes_written_ : bytes_read_) += message.size_bytes;
            client_.pushed(now);
        }
    }

    CacheClient& client_;
    std::unique_ptr<Vcache> unit_;
    rtl::FlatMemory memory_;
    rtl::CacheEvents events_;
    std::uint64_t reads_ = 0, replies_ = 0, bytes_read_ = 0, bytes_written_ = 0;
};

}  // namespace

CacheRun run_verilated(const CacheCase& test_case) {
    CacheClient client(test_case);
    VerilatedCache cache(test_case, client);
    Cycle left = drain_cycles(test_case), now = 0, last_event = 0;
    std::size_t events = 0;
    while (!client.is_done() || left-- != 0) {
        cache.cycle(now);
        if (client.events().size() != events) last_event = now;
        events = client.events().size();
        if (now - last_event > 100'000 || testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << "nothing has moved since cycle " << last_event;
            break;
        }
        ++now;
    }
    CacheRun run;
    run.events = client.events();
    run.cycles = now;
    run.counters = cache.counters();
    const rtl::FlatMemory::Counters& memory = cache.memory().counters();
    run.memory.reads = memory.reads;
    run.memory.writes = memory.writes;
    run.memory.read_bytes = memory.read_bytes;
    run.memory.write_bytes = memory.write_bytes;
    return run;
}

}  // namespace rtu::test
