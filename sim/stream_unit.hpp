#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "model/ray_setup.hpp"
#include "model/traversal.hpp"
#include "sim/clocked_unit.hpp"
#include "sim/config.hpp"
#include "sim/counter_table.hpp"
#include "sim/fifo.hpp"
#include "sim/link_message.hpp"
#include "sim/stream_job.hpp"

namespace rtu::sim {

struct StreamCounters {
    std::uint64_t batches = 0;
    std::uint64_t pair_tests = 0;
    std::uint64_t triangle_tests = 0;
    std::uint64_t exact_tests = 0;
    std::uint64_t replays = 0;
    std::uint64_t tester_cycles = 0;
    std::uint64_t memory_bytes = 0;
    friend bool operator==(const StreamCounters&, const StreamCounters&) = default;
};

inline constexpr std::array stream_counter_rows = std::to_array<CounterRow<StreamCounters>>({
    {"batches", "batches", "worked through", &StreamCounters::batches},
    {"pair_tests", "tests", "pairs and lone triangles tested", &StreamCounters::pair_tests},
    {"triangle_tests", "tests", "triangles in them", &StreamCounters::triangle_tests},
    {"exact_tests", "tests", "of those, left to the exact pass", &StreamCounters::exact_tests},
    {"replays", "replays", "pairs with two exact tests and one unit for them", &StreamCounters::replays},
    {"tester_cycles", "cycles", "cycles that testers were held, over all testers",
     &StreamCounters::tester_cycles},
    {"memory_bytes", "bytes", "operands read from memory because they did not fit into the buffer",
     &StreamCounters::memory_bytes},
});
static_assert(has_row_for_every_field(stream_counter_rows));

/// The dual-triangle testers of all RTUs without their traversal: they work through batches in order, one
/// after another, a test at a time each, with the intervals, latency and replays of PairUnit. Operands that
/// are not in the buffer come from memory, in order and ahead of their tests, at the DRAM's peak rate.
/// Results go to a buffer that always takes them.
///
/// Nothing outside can hold up a batch once it has begun, so all its tests are placed in time when it begins.
class StreamUnit final : public ClockedUnit {
  public:
    StreamUnit(sc_core::sc_module_name name, ClockDomain& domain, const Config& config, const StreamJob& job,
               const StreamPlan& plan);

    sc_core::sc_port<Fifo<BatchArrival>> batches_in{"batches_in"};
    sc_core::sc_port<Fifo<ItemsFinished>> finished_out{"finished_out"};

    [[nodiscard]] const StreamCounters& counters() const { return counters_; }
    /// The nearest hit of each ray, once all batches are finished.
    [[nodiscard]] std::vector<std::optional<model::Hit>> hits() const;
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;
    /// Throws std::logic_error unless every test of the job was done once and nothing is left.
    void check_drained() const;

  protected:
    Activity tick(Cycle now) override;
    [[nodiscard]] Activity between_events(Cycle now) const override;

  private:
    void begin_batch(Cycle now, const StreamBatch& batch);
    void place_test(Cycle begin, std::uint64_t ray, const model::LeafPair& pair, std::uint32_t far_bytes);
    [[nodiscard]] model::PairVisit test(std::uint64_t ray, const model::LeafPair& pair);
    [[nodiscard]] bool is_replayed(const model::PairVisit& visit) const;
    [[nodiscard]] std::uint32_t issue_cycles(const model::PairVisit& visit) const;

    Config::Rtu::Pair config_;
    std::uint64_t memory_bytes_per_cycle_;
    const StreamJob job_;
    const StreamPlan& plan_;
    std::vector<std::optional<model::RaySetup>> setups_;  // [ray]; none: it can hit nothing
    std::vector<model::Closest> closest_;                 // [ray]
    std::vector<Cycle> testers_;                          // when each is free
    std::deque<std::uint64_t> waiting_;                   // batches that have arrived
    std::deque<Cycle> finishing_;                         // when the last result of each batch is there
    Cycle free_at_ = 0;                                   // when the next batch can begin
    Cycle last_result_at_ = 0;                            // of the batch that was begun last
    std::uint64_t batch_far_bytes_ = 0;                   // read for it so far
    StreamCounters counters_;
};

}  // namespace rtu::sim
