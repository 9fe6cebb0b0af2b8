#include "study/fidelity/workload_profile.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "model/random.hpp"
#include "study/fidelity/reuse_distance.hpp"
#include "study/fidelity/unloaded_latency.hpp"

namespace rtu::study {
namespace {

constexpr std::uint32_t profile_purpose = 26;  // tells these random numbers from others
constexpr std::uint32_t block_count = 16;
constexpr std::uint32_t lattice_rays_per_block = 512;

// Traces rays side by side, as many as there are slots, one access of each in turn.
template <class OnAccess>
void trace_interleaved(const model::MemoryImage& image, std::span<const model::Ray> rays, model::RayKind kind,
                       std::uint32_t slot_count, OnAccess on_access) {
    std::vector<FunctionalWalk> walks(slot_count);
    std::vector<std::uint32_t> at_work(slot_count);
    std::uint32_t active = 0;
    std::size_t next = 0;
    const auto refill = [&](std::uint32_t slot) {
        while (next < rays.size()) {
            if (walks[slot].start(image, rays[next++], kind)) return true;
        }
        return false;
    };
    for (std::uint32_t slot = 0; slot < slot_count; ++slot)
        if (refill(slot)) at_work[active++] = slot;
    while (active > 0) {
        std::uint32_t kept = 0;
        for (std::uint32_t i = 0; i < active; ++i) {
            const std::uint32_t slot = at_work[i];
            on_access(slot, walks[slot].address(), walks[slot].size_bytes(image));
            if (walks[slot].step(image) || refill(slot)) at_work[kept++] = slot;
        }
        active = kept;
    }
}

class Profiler {
  public:
    Profiler(const sim::Config& config, const model::MemoryImage& image, const RayPopulation& population)
        : config_(config),
          image_(image),
          population_(population),
          slot_count_(config.rtu.ray_slots * config.rtu.count),
          l1_(config.l1.line_bytes, image.size_bytes()),
          l2_(config.l2.line_bytes, image.size_bytes()),
          lattice_lines_(image.size_bytes() / config.l2.line_bytes + 1, 0),
          on_their_way_(image.size_bytes() / config.l1.line_bytes + 1) {}

    WorkloadProfile run(std::uint64_t seed) {
        for (std::uint32_t b = 0; b < block_count; ++b) add_block(b, seed);
        limit_first_touches();
        return std::move(profile_);
    }

  private:
    void add_block(std::uint32_t index, std::uint64_t seed) {
        const std::uint64_t size = population_.size();
        const auto begin = std::uint32_t(size * index / block_count);
        const auto end = std::uint32_t(size * (index + 1) / block_count);
        if (begin == end) return;
        ProfileBlock& block = profile_.blocks.emplace_back();
        model::RandomStream random(seed, profile_purpose, index);
        const auto dense_begin = begin + std::uint32_t(double(random.next()) * double(end - begin));
        trace_lattice(begin, end, seed, block);
        measure_misses(dense_begin, block);
    }

    // One ray of each equal part: their mean work, and how many rays the block has.
    void trace_lattice(std::uint32_t begin, std::uint32_t end, std::uint64_t seed, ProfileBlock& block) {
        const std::uint32_t count = std::min(end - begin, lattice_rays_per_block);
        std::vector<std::uint32_t> positions(count);
        model::RandomStream random(seed, profile_purpose + 1, begin);
        for (std::uint32_t i = 0; i < count; ++i) {
            const double place = (i + double(random.next())) / count;
            positions[i] = begin + std::min(std::uint32_t(place * (end - begin)), end - begin - 1);
        }
        const PopulationPart part = population_.part(positions);
        RayWork sum;
        for (const model::Ray& ray : part.rays) {
            lattice_part_ = lattice_rays_ % 4 == 0 ? in_quarter : lattice_rays_ % 2 == 0 ? in_half : in_all;
            ++lattice_rays_;
            sum += trace_to_l2(ray);
            lattice_part_ = in_none;
        }
        block.rays = double(part.rays.size()) / count * (end - begin);
        if (!part.rays.empty()) block.per_ray = 1 / double(part.rays.size()) * sum;
    }

    RayWork trace_to_l2(const model::Ray& ray) {
        ++profile_.traced_rays;
        if (!walk_.start(image_, ray, population_.kind())) return walk_.work();
        bool goes_on = true;
        while (goes_on) {
            static_cast<void>(l2_.access(walk_.address(), walk_.size_bytes(image_)));
            if (lattice_part_ != in_none) note_lattice_access();
            const double before = walk_.work().box_tests;
            goes_on = walk_.step(image_);
            const double boxes = walk_.work().box_tests - before;
            if (boxes > 0) profile_.nodes_with[std::size_t(boxes)] += 1;
        }
        return walk_.work();
    }

    void measure_misses(std::uint32_t begin, ProfileBlock& block) {
        const std::uint32_t wanted = std::max(512U, 2 * slot_count_);
        const std::uint32_t before = std::min(begin, population_.row_length() + wanted);
        const std::uint32_t after = std::min(population_.size() - begin, wanted);
        const PopulationPart part = population_.part(begin - before, begin + after);
        const auto split =
            std::size_t(std::ranges::lower_bound(part.positions, begin) - part.positions.begin());
        const std::span<const model::Ray> rays(part.rays);
        // The L1 forgets a row; the L2 may not.
        const std::size_t recent = std::min<std::size_t>(split, wanted);
        for (const model::Ray& ray : rays.first(split - recent)) static_cast<void>(trace_to_l2(ray));
        trace_dense(rays.subspan(split - recent, recent), nullptr);
        trace_dense(rays.subspan(split), &block);
        const auto measured = double(rays.size() - split);
        if (measured == 0) return;
        for (double* value : {&block.lines_per_ray, &block.l1_misses_per_ray, &block.l2_misses_per_ray,
                              &block.first_touches_per_ray, &block.held_up_cycles_per_ray,
                              &block.held_up_by_first_touches_per_ray}) {
            *value /= measured;
        }
    }

    void note_lattice_access() {
        const std::uint64_t last = walk_.address() + walk_.size_bytes(image_) - 1;
        for (std::uint64_t line = walk_.address() / config_.l2.line_bytes;
             line <= last / config_.l2.line_bytes; ++line) {
            lattice_lines_[line] |= lattice_part_;
        }
    }

    // Distinct lines that `rays` rays touch. Doubling the number of rays multiplies them by a factor that
    // falls towards 1: the factors of the lattice's last two doublings tell how fast.
    [[nodiscard]] double distinct_lines(double rays) const {
        double quarter = 0, half = 0, all = 0;
        for (const std::uint8_t seen : lattice_lines_) {
            all += seen != 0 ? 1 : 0;
            half += (seen & (in_quarter | in_half)) != 0 ? 1 : 0;
            quarter += (seen & in_quarter) != 0 ? 1 : 0;
        }
        if (quarter == 0) return all;
        const double before = std::log2(half / quarter);
        double exponent = std::log2(all / half);
        const double decay = before > 0 ? std::min(exponent / before, 1.0) : 0.0;
        for (double doublings = std::log2(rays / double(lattice_rays_)); doublings > 0; --doublings) {
            exponent *= decay;
            all *= std::exp2(exponent * std::min(doublings, 1.0));
        }
        return std::min(all, double(lattice_lines_.size()));
    }

    // A run touches no line for the first time twice, but a sample takes for new what skipped rays touched.
    void limit_first_touches() {
        double found = 0, rays = 0;
        for (const ProfileBlock& block : profile_.blocks) {
            found += block.rays * block.first_touches_per_ray;
            rays += block.rays;
        }
        const double most = distinct_lines(rays);
        if (found <= most) return;
        for (ProfileBlock& block : profile_.blocks) {
            block.first_touches_per_ray *= most / found;
            block.held_up_by_first_touches_per_ray *= most / found;
        }
    }

    // Rays take turns on the RTUs, and so do slots. The first RTU's L1 stands for all.
    void trace_dense(std::span<const model::Ray> rays, ProfileBlock* block) {
        ProfileBlock unused;
        ProfileBlock& counts = block != nullptr ? *block : unused;
        profile_.traced_rays += rays.size();
        trace_interleaved(image_, rays, population_.kind(), slot_count_,
                          [&](std::uint32_t slot, std::uint64_t address, std::uint32_t bytes) {
                              const std::uint64_t distance = l2_.access(address, bytes);
                              if (slot % config_.rtu.count == 0) access_l1(address, bytes, distance, counts);
                          });
    }

    void access_l1(std::uint64_t address, std::uint32_t bytes, std::uint64_t l2_distance,
                   ProfileBlock& counts) {
        const std::uint64_t first = address / config_.l1.line_bytes;
        const std::uint64_t last = (address + bytes - 1) / config_.l1.line_bytes;
        const double lines = config_.rtu.count * double(last - first + 1);
        counts.lines_per_ray += lines;
        ++now_;
        if (l1_.access(address, bytes) < config_.l1.size_bytes / config_.l1.line_bytes) {
            join(first, counts);
            return;
        }
        const bool is_l2_miss = l2_distance >= config_.l2.size_bytes / config_.l2.line_bytes;
        const bool is_first_touch = l2_distance == ReuseDistances::never;
        counts.l1_misses_per_ray += lines;
        if (is_first_touch) {
            counts.first_touches_per_ray += lines;
        } else if (is_l2_miss) {
            counts.l2_misses_per_ray += lines;
        }
        const double latency = l2_cycles(config_) + (is_l2_miss ? dram_cycles(config_) : 0.0);
        on_their_way_[first] = {now_ + std::uint64_t(latency), 1, is_first_touch};
    }

    // An access to a line that may still be on its way.
    void join(std::uint64_t line, ProfileBlock& counts) {
        OnItsWay& found = on_their_way_[line];
        if (now_ >= found.until || ++found.accesses <= config_.l1.targets_per_mshr) return;
        // What is under way behind the L1 goes on for a while.
        const double slack = config_.l1.latency_cycles + box_latency_cycles(config_);
        const double held_up = std::max(0.0, double(found.until - now_) - slack);
        (found.is_first_touch ? counts.held_up_by_first_touches_per_ray : counts.held_up_cycles_per_ray) +=
            config_.rtu.count * held_up;
        now_ = found.until;
    }

    // Every fourth ray of the lattice, those half way between, and the others.
    static constexpr std::uint8_t in_none = 0, in_quarter = 1, in_half = 2, in_all = 4;

    struct OnItsWay {
        std::uint64_t until = 0;
        std::uint32_t accesses = 0;
        bool is_first_touch = false;
    };

    const sim::Config& config_;
    const model::MemoryImage& image_;
    const RayPopulation& population_;
    std::uint32_t slot_count_;
    ReuseDistances l1_, l2_;
    std::vector<std::uint8_t> lattice_lines_;  // [L2 line]: parts of the lattice that touched it
    std::uint64_t lattice_rays_ = 0;
    std::uint8_t lattice_part_ = in_none;  // of the ray under way
    std::vector<OnItsWay> on_their_way_;   // [L1 line]
    std::uint64_t now_ = 0;                // accesses of the first RTU
    FunctionalWalk walk_;
    WorkloadProfile profile_;
};

}  // namespace

WorkloadProfile profile_workload(const sim::Config& config, const model::MemoryImage& image,
                                 const RayPopulation& population, std::uint64_t seed) {
    return Profiler(config, image, population).run(seed);
}

}  // namespace rtu::study
