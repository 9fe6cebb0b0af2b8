#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/cache_tags.hpp"
#include "sim/memory_message.hpp"

namespace rtu::sim {

/// The reads that a cache cannot answer at once: they wait for a line from below or span several lines.
class PendingReads {
  public:
    struct Read {
        MemoryReply reply;
        std::uint8_t source = 0;
        std::uint32_t parts_left = 0;  ///< line accesses that have not found their data
    };

    /// Adds a read and returns its id. Ids are reused; storage grows to the most reads ever pending.
    std::uint32_t open(const Read& read) {
        if (free_ids_.empty()) {
            free_ids_.push_back(std::uint32_t(reads_.size()));
            reads_.emplace_back();
        }
        const std::uint32_t id = free_ids_.back();
        free_ids_.pop_back();
        reads_[id] = read;
        return id;
    }
    void close(std::uint32_t id) { free_ids_.push_back(id); }
    [[nodiscard]] Read& operator[](std::uint32_t id) { return reads_[id]; }
    [[nodiscard]] std::size_t size() const { return reads_.size() - free_ids_.size(); }

  private:
    std::vector<Read> reads_;
    std::vector<std::uint32_t> free_ids_;
};

/// A cache's miss-status holding registers: one for every line with sectors on their way, with the line
/// accesses (targets) that wait for them.
class Mshrs {
  public:
    struct Target {
        std::uint32_t read = 0;  ///< of PendingReads
        SectorMask sectors = 0;  ///< that it needs
    };
    /// What one request below asked for.
    struct Fetch {
        std::uint32_t mshr = 0;
        SectorMask sectors = 0;
    };

    Mshrs(std::uint32_t count, std::uint32_t targets_per_mshr, std::uint32_t sectors_per_line)
        : targets_per_mshr_(targets_per_mshr),
          sectors_per_line_(sectors_per_line),
          registers_(count),
          fetched_(std::size_t(count) * sectors_per_line) {
        for (std::uint32_t id = count; id-- > 0;) free_ids_.push_back(id);
    }

    [[nodiscard]] bool is_full() const { return free_ids_.empty(); }
    [[nodiscard]] std::size_t size() const { return registers_.size() - free_ids_.size(); }

    /// Takes a free register for the line in `entry` of the tags.
    std::uint32_t open(std::uint32_t entry) {
        const std::uint32_t id = free_ids_.back();
        free_ids_.pop_back();
        registers_[id].entry = entry;
        return id;
    }
    void close(std::uint32_t id) { free_ids_.push_back(id); }
    [[nodiscard]] std::uint32_t entry(std::uint32_t id) const { return registers_[id].entry; }

    [[nodiscard]] bool can_add_target(std::uint32_t id) const {
        return registers_[id].targets.size() < targets_per_mshr_;
    }
    void add_target(std::uint32_t id, Target target) { registers_[id].targets.push_back(target); }
    [[nodiscard]] bool has_targets(std::uint32_t id) const { return !registers_[id].targets.empty(); }
    /// The first target in order of arrival that needs nothing outside `sectors`; its index in the list.
    [[nodiscard]] std::optional<std::size_t> satisfied_target(std::uint32_t id, SectorMask sectors) const {
        const std::vector<Target>& targets = registers_[id].targets;
        const auto found =
            std::ranges::find_if(targets, [&](const Target& t) { return (t.sectors & ~sectors) == 0; });
        if (found == targets.end()) return std::nullopt;
        return std::size_t(found - targets.begin());
    }
    [[nodiscard]] Target target(std::uint32_t id, std::size_t index) const {
        return registers_[id].targets[index];
    }
    void remove_target(std::uint32_t id, std::size_t index) {
        std::vector<Target>& targets = registers_[id].targets;
        targets.erase(targets.begin() + std::ptrdiff_t(index));
    }

    /// Notes a request below; returns the tag under which `fetch` finds it. A sector is asked for once until
    /// it arrives, so the register and the first sector name the request.
    std::uint32_t note_fetch(std::uint32_t id, SectorMask sectors) {
        const std::uint32_t tag = id * sectors_per_line_ + std::uint32_t(std::countr_zero(sectors));
        fetched_[tag] = sectors;
        return tag;
    }
    [[nodiscard]] Fetch fetch(std::uint32_t tag) const { return {tag / sectors_per_line_, fetched_[tag]}; }

  private:
    struct Register {
        std::uint32_t entry = 0;
        std::vector<Target> targets;  // keeps its capacity: no allocation once it has grown
    };

    std::uint32_t targets_per_mshr_;
    std::uint32_t sectors_per_line_;
    std::vector<Register> registers_;
    std::vector<std::uint32_t> free_ids_;
    std::vector<SectorMask> fetched_;  // [register * sectors_per_line + first sector]
};

}  // namespace rtu::sim
