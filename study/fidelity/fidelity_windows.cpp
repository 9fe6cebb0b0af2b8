#include "study/fidelity/fidelity_windows.hpp"

#include <algorithm>
#include <deque>
#include <optional>

#include "model/random.hpp"
#include "study/fidelity/analytic_model.hpp"

namespace rtu::study {
namespace {

// Tells these random numbers from those of workloads and of other studies.
constexpr std::uint32_t lattice_purpose = 24, window_purpose = 25, block_purpose = 28;

// A stretch of the population that is simulated: settling rays, then the window's.
struct Stretch {
    std::vector<model::Ray> warm;  // before it, to be traced without a clock
    std::uint32_t begin = 0;       // of the window
    std::uint64_t settling = 0;    // rays
    PopulationPart window;
};

// Where the windows of the middle begin: one in each share of it that has none yet.
std::vector<std::uint32_t> window_begins(std::uint32_t size, const WindowPlan& plan) {
    const std::uint32_t length = plan.window_length;
    const double share = double(size - 2 * std::uint64_t(length)) / plan.stratum_count;
    std::vector<bool> is_taken(plan.stratum_count);
    for (const std::uint32_t begin : plan.taken) {
        is_taken[std::min(plan.stratum_count - 1, std::uint32_t((begin - length) / share))] = true;
    }
    std::vector<std::uint32_t> begins;
    for (std::uint32_t k = 0; k < plan.stratum_count; ++k) {
        if (is_taken[k]) continue;
        // At random: equal distances would meet the same columns of a picture again and again.
        model::RandomStream random(plan.seed, window_purpose, k);
        begins.push_back(length + std::uint32_t(share * k + double(random.next()) * (share - length)));
    }
    return begins;
}

// Hands the rays of one stretch after another to the machine, and makes them no earlier than they are wanted.
class StretchSupply final : public sim::RaySupply {
  public:
    StretchSupply(const RayPopulation& population, const WindowPlan& plan)
        : population_(population), plan_(plan) {
        begins_ = window_begins(population.size(), plan);
        if (!plan.has_ends_and_blocks) return;
        begins_.insert(begins_.begin(), 0);
        begins_.push_back(population.size() - plan.window_length);
    }

    [[nodiscard]] std::size_t stretch_count() const { return begins_.size(); }
    [[nodiscard]] const Stretch& stretch(std::size_t index) {
        while (stretches_.size() <= index) prepare();
        return stretches_[index];
    }
    [[nodiscard]] std::optional<sim::SuppliedRay> next() override {
        while (rays_.empty() && stretches_.size() < begins_.size()) prepare();
        if (rays_.empty()) return std::nullopt;
        const sim::SuppliedRay ray{rays_.front(), {}};
        rays_.pop_front();
        return ray;
    }
    [[nodiscard]] double share() const override { return double(stretches_.size()) / double(begins_.size()); }

  private:
    void prepare() {
        const std::size_t index = stretches_.size();
        const std::uint32_t begin = begins_[index];
        const std::uint32_t earliest = index == 0 ? 0 : begins_[index - 1] + plan_.window_length;
        const std::uint32_t from = std::max(earliest, begin - std::min(begin, plan_.warm_length));
        const PopulationPart part = population_.part(from, begin + plan_.window_length);
        const auto before =
            std::uint64_t(std::ranges::lower_bound(part.positions, begin) - part.positions.begin());
        Stretch& stretch = stretches_.emplace_back();
        stretch.begin = begin;
        stretch.settling = std::min<std::uint64_t>(before, plan_.settling_rays);
        const auto settling = part.rays.begin() + std::ptrdiff_t(before - stretch.settling);
        stretch.window = {{part.rays.begin() + std::ptrdiff_t(before), part.rays.end()},
                          {part.positions.begin() + std::ptrdiff_t(before), part.positions.end()}};
        stretch.warm.assign(part.rays.begin(), settling);
        rays_.insert(rays_.end(), settling, part.rays.end());
    }

    const RayPopulation& population_;
    WindowPlan plan_;
    std::vector<std::uint32_t> begins_;
    std::deque<Stretch> stretches_;
    std::deque<model::Ray> rays_;
};

// A stretch of `length` positions in each `stride` of the middle, at random within it: where it begins.
std::vector<std::uint32_t> spread(std::uint32_t size, const WindowPlan& plan, std::uint32_t stride,
                                  std::uint32_t length, std::uint32_t purpose) {
    std::vector<std::uint32_t> positions;
    const std::uint64_t end = size - plan.window_length;
    for (std::uint64_t begin = plan.window_length; begin < end; begin += stride) {
        const std::uint64_t share = std::min<std::uint64_t>(stride, end - begin);
        if (share < length) break;
        model::RandomStream random(plan.seed, purpose, std::uint32_t(begin));
        const double place = double(random.next()) * double(share - length + 1);
        positions.push_back(std::uint32_t(begin + std::uint64_t(place)));
    }
    return positions;
}

WindowSample between(const sim::MachineMark& begin, const sim::MachineMark& end) {
    const auto delta = [&](auto member) { return double(end.counts.*member - begin.counts.*member); };
    using Counts = model::TraversalCounts;
    return {double(end.cycles - begin.cycles),
            {double(end.rays - begin.rays), delta(&Counts::node_visits), delta(&Counts::box_tests),
             double(end.leaf_visits - begin.leaf_visits), delta(&Counts::pair_tests),
             delta(&Counts::triangle_tests)}};
}

class Measuring {
  public:
    Measuring(const sim::Config& config, const model::MemoryImage& image, const RayPopulation& population,
              const WindowPlan& plan)
        : config_(config),
          image_(image),
          population_(population),
          length_(plan.window_length),
          block_length_(plan.block_length),
          supply_(population, plan),
          session_(config, image, supply_, population.kind()),
          lattice_(spread(population.size(), plan, plan.lattice_stride, 1, lattice_purpose)),
          has_ends_(plan.has_ends_and_blocks),
          has_image_in_l2_(plan.has_image_in_l2) {
        if (has_ends_)
            blocks_ = spread(population.size(), plan, plan.block_stride, plan.block_length, block_purpose);
        if (!has_image_in_l2_) return;
        for (std::uint64_t address = 0; address < image.size_bytes(); address += model::image_block_bytes) {
            session_.warm(0, address, model::image_block_bytes);
        }
    }

    WindowMeasurement run() {
        result_.window_length = length_;
        result_.block_length = block_length_;
        result_.middle_length = population_.size() - 2 * std::uint64_t(length_);
        const std::size_t count = supply_.stretch_count();
        for (std::size_t i = 0; i < count; ++i) {
            const Stretch& stretch = supply_.stretch(i);
            const bool is_first = has_ends_ && i == 0, is_last = has_ends_ && i + 1 == count;
            const WindowSample sample = measure(stretch, is_last);
            if (is_first || is_last) {
                (is_first ? result_.first : result_.last) = sample;
                continue;
            }
            result_.windows.push_back(sample);
            result_.windows.back().begin = stretch.begin;
            result_.windows.back().traced = trace_blocks(stretch.window, stretch.begin, false);
        }
        trace_between(population_.size());
        return std::move(result_);
    }

  private:
    WindowSample measure(const Stretch& stretch, bool is_last) {
        trace_between(stretch.begin);
        for (const model::Ray& ray : stretch.warm) static_cast<void>(trace(ray, true));
        handed_ += stretch.settling;
        session_.advance_to(handed_);
        const sim::MachineMark begin = session_.mark();
        handed_ += stretch.window.rays.size();
        if (is_last) {
            session_.finish();
        } else {
            session_.advance_to(handed_);
        }
        result_.simulated_rays += stretch.settling + stretch.window.rays.size();
        return between(begin, session_.mark());
    }

    // What of the lattice and the blocks lies before `end`.
    void trace_between(std::uint32_t end) {
        const auto stop = std::lower_bound(lattice_.begin() + std::ptrdiff_t(traced_), lattice_.end(), end);
        const std::span<const std::uint32_t> positions(lattice_.begin() + std::ptrdiff_t(traced_), stop);
        const PopulationPart part = population_.part(positions);
        std::size_t next = 0;
        for (const std::uint32_t position : positions) {
            const bool has_ray = next < part.positions.size() && part.positions[next] == position;
            result_.lattice.push_back(has_ray ? trace(part.rays[next++], !has_image_in_l2_) : RayWork{});
        }
        traced_ += positions.size();
        for (; result_.blocks.size() < blocks_.size() && blocks_[result_.blocks.size()] < end;) {
            const std::uint32_t begin = blocks_[result_.blocks.size()];
            result_.blocks.push_back(
                trace_blocks(population_.part(begin, begin + block_length_), begin, !has_image_in_l2_));
        }
    }

    // Rays of whole blocks, the first of which begins at `begin`.
    TracedWork trace_blocks(const PopulationPart& part, std::uint32_t begin, bool warms) {
        TracedWork all;
        for (std::size_t i = 0; i < part.rays.size();) {
            const std::uint32_t end =
                begin + ((part.positions[i] - begin) / block_length_ + 1) * block_length_;
            RayWork block;
            for (; i < part.rays.size() && part.positions[i] < end; ++i) {
                const RayWork work = trace(part.rays[i], warms);
                all.least_cycles_alone += least_cycles(config_, work);
                block += work;
            }
            all.work += block;
            all.least_cycles += least_cycles(config_, block);
        }
        return all;
    }

    // Without a clock; its memory accesses go into the caches when it `warms` them.
    RayWork trace(const model::Ray& ray, bool warms) {
        const std::uint32_t rtu = std::uint32_t(result_.traced_rays++ % config_.rtu.count);
        model::trace(stack_, image_, ray, population_.kind(), log_);
        if (warms) {
            for (const model::NodeRef ref : log_.visits) {
                session_.warm(rtu, ref.address(), fetched_bytes(image_, ref));
            }
        }
        return work_of(log_);
    }

    const sim::Config& config_;
    const model::MemoryImage& image_;
    const RayPopulation& population_;
    std::uint32_t length_, block_length_;
    StretchSupply supply_;
    sim::MachineSession session_;
    std::vector<std::uint32_t> lattice_, blocks_;
    bool has_ends_, has_image_in_l2_;
    std::size_t traced_ = 0;  // of the lattice
    std::uint64_t handed_ = 0;
    model::TraversalStack stack_;
    model::TraversalLog log_;
    WindowMeasurement result_;
};

}  // namespace

std::uint64_t simulated_length(const WindowPlan& plan) {
    const std::uint64_t windows = plan.stratum_count - plan.taken.size() + (plan.has_ends_and_blocks ? 2 : 0);
    return windows * (plan.window_length + plan.settling_rays);
}

WindowMeasurement measure_windows(const sim::Config& config, const model::MemoryImage& image,
                                  const RayPopulation& population, const WindowPlan& plan) {
    return Measuring(config, image, population, plan).run();
}

}  // namespace rtu::study
