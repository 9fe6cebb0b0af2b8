#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

#include "sim/cache_tags.hpp"
#include "sim/clocked_unit.hpp"
#include "sim/config.hpp"
#include "sim/fifo.hpp"
#include "sim/memory_counters.hpp"
#include "sim/memory_message.hpp"
#include "sim/mshrs.hpp"
#include "sim/pipeline.hpp"
#include "sim/write_back_buffer.hpp"

namespace rtu::sim {

/// A banked, sectored, write-back cache: an RTU's L1 or the L2 that all share. It times accesses; it holds no
/// data.
///
/// Reads. A read is split into line accesses; its reply leaves when all have found their data. Each input's
/// requests are taken in order, several a cycle, but a bank (line number modulo banks) serves one line access
/// a cycle; the input that is asked first changes every cycle. A hit accepted in cycle t replies in cycle
/// t + latency_cycles. A miss asks below for its missing sectors in cycle t: one request, from the first to
/// the last missing sector. The fill then takes its line's bank for one cycle for each access that waited for
/// it, and each of those replies latency_cycles later. An access whose missing sectors are all on their way
/// joins the line's MSHR instead. Whatever is refused keeps its input waiting.
///
/// Writes are posted and allocate without fetching: a sector is valid and dirty as a whole as soon as a write
/// touches it, in part or in whole: the model holds no data. A replaced line sends each run of adjacent dirty
/// sectors below as one write, ahead of requests; a miss on a line that is still being written back waits.
class Cache final : public ClockedUnit {
  public:
    /// `input_count` request channels; a request's `source` picks one of `reply_count` reply channels.
    /// Requests below carry `source_below`.
    Cache(sc_core::sc_module_name name, ClockDomain& domain, const Config::Cache& config,
          std::size_t input_count, std::size_t reply_count, std::uint8_t source_below);

    sc_core::sc_vector<sc_core::sc_port<Fifo<MemoryRequest>>> requests_in;
    sc_core::sc_vector<sc_core::sc_port<PushIf<MemoryReply>>> replies_out;
    sc_core::sc_port<PushIf<MemoryRequest>> below_out{"below_out"};
    sc_core::sc_port<Fifo<MemoryReply>> fills_in{"fills_in"};  ///< replies to below_out's reads, in any order

    /// Puts the bytes into the cache in no time and uncounted, as a read long ago would have: for warming it
    /// up between two cycles. Calls `missing(address, size_bytes)` for each run of sectors of a line that was
    /// not there; dirty lines that make room are forgotten.
    template <class F>
    void warm(std::uint64_t address, std::uint32_t size_bytes, F missing) {
        const std::uint64_t last = address + size_bytes - 1;
        for (std::uint64_t line = address >> line_shift_; line <= last >> line_shift_; ++line) {
            const std::uint64_t base = line << line_shift_;
            const std::uint64_t from = std::max(address, base);
            const std::uint64_t to = std::min(last, base + (std::uint64_t(1) << line_shift_) - 1);
            const SectorMask absent =
                warm_line(std::uint32_t(line), std::uint32_t((from - base) >> sector_shift_),
                          std::uint32_t((to - base) >> sector_shift_));
            if (absent == 0) continue;
            const auto first = std::uint32_t(std::countr_zero(absent));
            missing(base + (std::uint64_t(first) << sector_shift_),
                    std::uint32_t(std::bit_width(absent) - int(first)) << sector_shift_);
        }
    }

    [[nodiscard]] const CacheCounters& counters() const { return counters_; }
    [[nodiscard]] Cycle next_event(Cycle now) const override;
    [[nodiscard]] std::string describe() const override;
    /// Throws std::logic_error unless every read was answered and every counter adds up. Written-back lines
    /// may still be on their way: nobody waits for them.
    void check_drained() const;

  protected:
    Activity tick(Cycle now) override;

  private:
    /// Why an access was not accepted: the counter that it is charged to; null when it was.
    using Refusal = std::uint64_t CacheCounters::*;
    struct Input {
        Fifo<MemoryRequest>* channel = nullptr;
        std::uint32_t lines_done = 0;  // of the request at the head
        std::uint32_t read = 0;        // of PendingReads, once lines_done > 0 and the head is a read
    };
    struct Output {
        PushIf<MemoryReply>* channel;
        Pipeline<MemoryReply> pipeline;
    };
    /// One line's share of a request.
    struct LineAccess {
        std::uint32_t line_number;
        std::uint32_t line_count;  // of the whole request
        SectorMask sectors;
    };
    struct Allocation {
        std::uint32_t entry = 0;
        Refusal refusal = nullptr;
    };

    [[nodiscard]] SectorMask warm_line(std::uint32_t line_number, std::uint32_t first_sector,
                                       std::uint32_t last_sector);
    void end_of_elaboration() override;
    void send_replies(Cycle now);
    void send_write_back(Cycle now);
    void take_fills(Cycle now);
    [[nodiscard]] bool take_fill(Cycle now, const Mshrs::Fetch& fetch);
    void accept(Cycle now);
    void accept_from(Cycle now, Input& input);
    [[nodiscard]] LineAccess next_access(const Input& input, const MemoryRequest& request) const;
    [[nodiscard]] Refusal read_line(Cycle now, Input& input, const MemoryRequest& request,
                                    const LineAccess& access);
    [[nodiscard]] Refusal miss_line(Cycle now, Input& input, const MemoryRequest& request,
                                    const LineAccess& access, std::optional<std::uint32_t> entry);
    [[nodiscard]] Refusal write_line(const LineAccess& access);
    [[nodiscard]] Allocation allocate(std::uint32_t line_number);
    void fetch(Cycle now, std::uint32_t entry, SectorMask sectors);
    [[nodiscard]] std::uint32_t pending_read(Input& input, const MemoryRequest& request,
                                             const LineAccess& access);
    void finish_part(Cycle now, std::uint32_t read);
    [[nodiscard]] std::uint64_t bank_bit(std::uint32_t line_number) const {
        return std::uint64_t(1) << (line_number & bank_mask_);
    }

    std::uint32_t line_shift_;
    std::uint32_t sector_shift_;
    std::uint32_t bank_mask_;
    std::uint8_t source_below_;
    CacheTags tags_;
    Mshrs mshrs_;
    PendingReads reads_;
    WriteBackBuffer write_backs_;
    std::vector<Input> inputs_;
    std::vector<Output> outputs_;
    PushIf<MemoryRequest>* below_ = nullptr;
    Fifo<MemoryReply>* fills_ = nullptr;
    // Of the current cycle.
    std::uint64_t busy_banks_ = 0;
    bool has_moved_ = false;
    bool is_blocked_ = false;
    CacheCounters counters_;
};

}  // namespace rtu::sim
