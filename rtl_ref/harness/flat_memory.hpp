#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/error.hpp"

namespace rtu::rtl {

/// Memory behind a Verilated cache, with its contents: one latency, one bandwidth, all in order.
///
/// One request at a time is on the bus, for ceil(bytes / bytes_per_cycle) cycles, and the next is taken when
/// the bus is free. A read's fill is offered that many cycles and `latency_cycles` after it was taken, one a
/// cycle. A read that would be the (latency_cycles + 3)rd under way waits. Writes are in memory at once.
///
/// `Unit` has the cache's ports to memory (mem_..., fill_..., see cache.sv). In every cycle: offer(), settle
/// the unit, finish(), settle again, clock edge.
class FlatMemory {
  public:
    static constexpr std::size_t line_bytes = 128;
    static constexpr std::size_t sector_bytes = 32;

    struct Timing {
        std::uint32_t latency_cycles = 100;
        std::uint32_t bytes_per_cycle = 32;
    };
    struct Counters {
        std::uint64_t reads = 0;
        std::uint64_t writes = 0;
        std::uint64_t read_bytes = 0;
        std::uint64_t write_bytes = 0;
    };

    /// `bytes`: the contents from address 0 on. They are extended with zeros to whole lines.
    FlatMemory(Timing timing, std::vector<std::byte> bytes) : timing_(timing), bytes_(std::move(bytes)) {
        bytes_.resize((bytes_.size() + line_bytes - 1) / line_bytes * line_bytes);
    }

    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }
    [[nodiscard]] const Counters& counters() const { return counters_; }
    [[nodiscard]] bool is_idle() const { return fills_.empty() && bus_free_at_ <= now_; }

    /// Offers the fill whose time has come; later, if it is not willing to begin with one.
    template <class Unit>
    void offer(Unit& unit, bool is_willing = true) {
        is_offered_ |= is_willing;
        const bool has_fill = !fills_.empty() && fills_.front().ready_at <= now_ && is_offered_;
        unit.fill_valid_i = has_fill;
        if (!has_fill) return;
        const Fill& fill = fills_.front();
        unit.fill_id_i = std::remove_cvref_t<decltype(unit.fill_id_i)>(fill.id);
        std::memcpy(unit.fill_data_i.data(), fill.line.data(), line_bytes);
    }

    /// Sees what the unit takes and asks for in this cycle, and answers whether its request is taken: not if
    /// it is not willing.
    template <class Unit>
    void finish(Unit& unit, bool is_willing = true) {
        if (unit.fill_valid_i && unit.fill_ready_o) fills_.pop_front();
        is_offered_ = unit.fill_valid_i && !unit.fill_ready_o;
        const bool has_room = unit.mem_is_write_o || fills_.size() < std::size_t(timing_.latency_cycles) + 2;
        unit.mem_ready_i = bus_free_at_ <= now_ && has_room && is_willing;
        if (unit.mem_ready_i && unit.mem_valid_o) take(unit);
        ++now_;
    }

  private:
    struct Fill {
        std::uint64_t ready_at = 0;
        std::uint32_t id = 0;
        std::vector<std::byte> line;  // as it was when the request was taken
    };

    template <class Unit>
    void take(const Unit& unit) {
        const std::size_t begin = std::size_t(unit.mem_line_o) * line_bytes;
        const auto sectors = std::uint32_t(unit.mem_sectors_o);
        RTU_CHECK(begin + line_bytes <= bytes_.size() && sectors != 0,
                  "memory: sectors {:b} of the line at {}, but there are {} bytes", sectors, begin,
                  bytes_.size());
        const std::uint32_t count = std::uint32_t(std::popcount(sectors)) * std::uint32_t(sector_bytes);
        bus_free_at_ = now_ + (count + timing_.bytes_per_cycle - 1) / timing_.bytes_per_cycle;
        const auto line = bytes_.begin() + std::ptrdiff_t(begin);
        if (unit.mem_is_write_o) {
            ++counters_.writes;
            counters_.write_bytes += count;
            write(unit.mem_data_o.data(), begin, sectors);
        } else {
            ++counters_.reads;
            counters_.read_bytes += count;
            fills_.push_back({bus_free_at_ + timing_.latency_cycles,
                              std::uint32_t(unit.mem_id_o),
                              {line, line + std::ptrdiff_t(line_bytes)}});
        }
    }

    void write(const void* line, std::size_t begin, std::uint32_t sectors) {
        for (std::size_t sector = 0; sector < line_bytes / sector_bytes; ++sector) {
            if ((sectors >> sector & 1U) == 0) continue;
            const std::size_t offset = sector * sector_bytes;
            std::memcpy(bytes_.data() + begin + offset, static_cast<const std::byte*>(line) + offset,
                        sector_bytes);
        }
    }

    Timing timing_;
    std::vector<std::byte> bytes_;
    std::deque<Fill> fills_;
    bool is_offered_ = false;  // the oldest fill
    std::uint64_t now_ = 0;
    std::uint64_t bus_free_at_ = 0;
    Counters counters_;
};

}  // namespace rtu::rtl
