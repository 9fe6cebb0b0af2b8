#pragma once

// One run of a Verilated RTU: what rtl_machine.cpp instantiates for each build.

#include <verilated.h>

#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <random>

#include "model/error.hpp"
#include "model/ray_setup.hpp"
#include "model/stack_region.hpp"
#include "rtl_ref/harness/flat_memory.hpp"
#include "rtl_ref/harness/rtl_machine.hpp"
#include "rtl_ref/harness/wave_file.hpp"

namespace rtu::rtl {

/// Whether the sides of an RTU are willing in a cycle.
class Willing {
  public:
    explicit Willing(const Disturbance* disturbance)
        : hesitates_(disturbance != nullptr && disturbance->hesitates),
          random_(disturbance != nullptr ? disturbance->seed : 0) {}
    bool operator()() { return !hesitates_ || random_() % 4 != 0; }

  private:
    bool hesitates_;
    std::mt19937_64 random_;
};

template <class Port>
void set_vector(Port& port, const model::Vec3& v) {
    static_assert(sizeof port == sizeof v);
    std::memcpy(&port, &v, sizeof v);
}

/// A Verilated rtu with its memory, cycle by cycle.
template <class Top>
class RtlRun {
  public:
    RtlRun(const model::MemoryImage& image, std::span<const model::Ray> rays, model::RayKind kind,
           const RtlConfig& config, const Waves* waves, const Disturbance* disturbance)
        : image_(image),
          rays_(rays),
          kind_(kind),
          config_(config),
          stacks_(model::stack_region(image, config.stack_entries, FlatMemory::line_bytes)),
          memory_({config.memory.latency_cycles, config.memory.bytes_per_cycle}, contents()),
          willing_(disturbance) {
        if (disturbance != nullptr) {
            context_.randReset(2);
            context_.randSeed(int(disturbance->seed + 1));
        }
        context_.traceEverOn(waves != nullptr);
        unit_ = std::make_unique<Top>(&context_, "rtu");
        if (waves != nullptr) waves_ = std::make_unique<typename WaveFileOf<Top>::Type>(*unit_, *waves);
        result_.hits.resize(rays.size());
        is_returned_.resize(rays.size());
    }

    RtlResult run() {
        configure();
        reset();
        while (returned_ < rays_.size()) {
            cycle();
            RTU_CHECK(now_ - last_progress_ < patience_cycles,
                      "rtu: no progress for {} cycles, {} of {} hits", patience_cycles, returned_,
                      rays_.size());
        }
        if (!rays_.empty()) result_.cycles = now_ - first_accepted_;
        unit_->final();
        if (waves_) waves_->finish(now_);
        return std::move(result_);
    }

  private:
    static constexpr std::uint64_t patience_cycles = 100'000;

    std::vector<std::byte> contents() const {
        std::vector<std::byte> bytes(stacks_.base_address + stacks_.slot_bytes * config_.slots);
        std::memcpy(bytes.data(), image_.blocks.data(), image_.size_bytes());
        return bytes;
    }

    void configure() {
        unit_->last_slot_i = std::uint8_t(config_.slots - 1);
        unit_->stack_entries_i = std::uint8_t(config_.stack_entries);
        unit_->mailbox_entries_i = std::uint8_t(config_.mailbox_entries);
        unit_->stack_base_i = std::uint32_t(stacks_.base_address);
        unit_->stack_slot_bytes_i = std::uint16_t(stacks_.slot_bytes);
        unit_->set_mask_i = std::uint8_t(config_.cache.sets - 1);
        unit_->last_way_i = std::uint8_t(config_.cache.ways - 1);
        unit_->bank_mask_i = std::uint8_t(config_.cache.banks - 1);
        unit_->last_mshr_i = std::uint8_t(config_.cache.mshrs - 1);
        unit_->last_target_i = std::uint8_t(config_.cache.targets_per_mshr - 1);
        unit_->last_latency_i = std::uint8_t(config_.cache.latency_cycles - 1);
    }

    void settle() {
        unit_->clk_i = 0;
        unit_->eval();
    }

    void clock_edge() {
        if (waves_) waves_->dump(now_, false);
        unit_->clk_i = 1;
        unit_->eval();
        if (waves_) waves_->dump(now_, true);
    }

    void reset() {
        unit_->ray_valid_i = 0;
        unit_->hit_ready_i = 0;
        unit_->mem_ready_i = 0;
        unit_->fill_valid_i = 0;
        unit_->rst_ni = 1;
        settle();
        unit_->rst_ni = 0;  // its falling edge clears what has an asynchronous reset
        settle();
        unit_->clk_i = 1;
        unit_->eval();
        unit_->rst_ni = 1;
        settle();
        for (std::uint32_t i = 0; i < patience_cycles && !unit_->is_ready_o; ++i) {
            unit_->clk_i = 1;
            unit_->eval();
            settle();
        }
        RTU_CHECK(unit_->is_ready_o, "rtu: the cache does not become ready");
    }

    void cycle() {
        offer_ray();
        memory_.offer(*unit_, willing_());
        memory_.finish(*unit_, willing_());  // what it looks at depends on registers only
        unit_->hit_ready_i = willing_() ? 3 : willing_() ? 1 : 0;
        settle();
        count();
        take_hits();
        if (unit_->ray_valid_i && unit_->ray_ready_o) {
            if (accepted_++ == 0) first_accepted_ = now_;
            last_progress_ = now_;
            is_offered_ = false;
        }
        clock_edge();
        ++now_;
    }

    // A ray that was offered stays until it is accepted.
    void offer_ray() {
        if (!is_offered_ && accepted_ < rays_.size() && willing_()) {
            drive(rays_[accepted_]);
            is_offered_ = true;
        }
        unit_->ray_valid_i = is_offered_;
    }

    void drive(const model::Ray& ray) {
        const bool can_hit = model::can_hit(ray);
        const model::RaySetup setup = can_hit ? model::make_ray_setup(ray, image_.bounds) : model::RaySetup{};
        Top& unit = *unit_;
        unit.ray_tag_i = std::uint32_t(accepted_);
        unit.ray_can_hit_i = can_hit;
        unit.ray_any_hit_i = kind_ == model::RayKind::AnyHit;
        set_vector(unit.ray_origin_i, setup.origin);
        set_vector(unit.ray_direction_i, setup.direction);
        set_vector(unit.ray_origin_near_i, setup.origin_near);
        set_vector(unit.ray_origin_far_i, setup.origin_far);
        set_vector(unit.ray_inv_direction_i, setup.inv_direction);
        unit.ray_entry_side_i =
            std::uint8_t(setup.entry_side[0] | setup.entry_side[1] << 1 | setup.entry_side[2] << 2);
        unit.ray_kz_i = setup.kz;
        unit.ray_shear_x_i = std::bit_cast<std::uint32_t>(setup.shear_x);
        unit.ray_shear_y_i = std::bit_cast<std::uint32_t>(setup.shear_y);
        unit.ray_t_min_i = std::bit_cast<std::uint32_t>(setup.t_min);
        unit.ray_t_max_i = std::bit_cast<std::uint32_t>(setup.t_max);
    }

    void take_hits() {
        for (std::uint32_t i = 0; i < 2; ++i) {
            if ((unit_->hit_valid_o & unit_->hit_ready_i) >> i == 0) break;
            std::array<std::uint32_t, 2> tags;
            static_assert(sizeof unit_->hit_tag_o == sizeof tags);
            std::memcpy(&tags, &unit_->hit_tag_o, sizeof tags);
            RTU_CHECK(tags[i] < rays_.size() && !is_returned_[tags[i]],
                      "rtu: a hit of ray {}, which is not under way", tags[i]);
            is_returned_[tags[i]] = true;
            if ((unit_->hit_found_o >> i & 1) != 0) {
                std::array<model::Hit, 2> hits;  // as in the port: t, u, v, primitive id
                static_assert(sizeof unit_->hit_o == sizeof hits);
                std::memcpy(&hits, &unit_->hit_o, sizeof hits);
                result_.hits[tags[i]] = hits[i];
            }
            ++returned_;
            last_progress_ = now_;
        }
    }

    void count() {
        if (unit_->node_visit_o) {
            ++result_.counts.node_visits;
            result_.counts.box_tests += unit_->node_children_o;
        }
        if (unit_->pair_test_o) {
            ++result_.counts.pair_tests;
            result_.counts.triangle_tests += unit_->pair_has_second_o ? 2 : 1;
        }
        result_.mailbox_lookups += std::uint32_t(std::popcount(std::uint32_t(unit_->mailbox_lookup_o)));
        result_.counts.mailbox_hits += std::uint32_t(std::popcount(std::uint32_t(unit_->mailbox_hit_o)));
        const std::uint32_t block = model::spill_block_size(config_.stack_entries);
        result_.spilled_entries += block * unit_->block_write_o;
        result_.reloaded_entries += block * std::uint32_t(std::popcount(std::uint32_t(unit_->block_read_o)));
        // The lowest bits: hits, misses and merges, one a bank.
        const auto events = std::uint32_t(unit_->cache_events_o);
        result_.cache_hits += std::uint32_t(std::popcount(events & 0xfU));
        result_.cache_misses += std::uint32_t(std::popcount(events >> 4 & 0xfU));
        result_.cache_merges += std::uint32_t(std::popcount(events >> 8 & 0xfU));
    }

    const model::MemoryImage& image_;
    std::span<const model::Ray> rays_;
    model::RayKind kind_;
    RtlConfig config_;
    model::StackRegion stacks_;
    FlatMemory memory_;
    Willing willing_;
    VerilatedContext context_;
    std::unique_ptr<Top> unit_;
    std::unique_ptr<typename WaveFileOf<Top>::Type> waves_;
    RtlResult result_;
    std::vector<bool> is_returned_;
    bool is_offered_ = false;
    std::size_t accepted_ = 0, returned_ = 0;
    std::uint64_t now_ = 0, first_accepted_ = 0, last_progress_ = 0;
};

}  // namespace rtu::rtl
