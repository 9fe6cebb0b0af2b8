#include "study/fidelity/fidelity_windows.hpp"

#include <algorithm>
#include <deque>
#include <optional>

#include "model/random.hpp"

namespace rtu::study {
namespace {

// Tells these random numbers from those of workloads and of other studies.
constexpr std::uint32_t lattice_purpose = 24, window_purpose = 25;

// A stretch of the population that is simulated: settling rays, then the window's.
struct Stretch {
    std::vector<model::Ray> warm;            // before it, to be traced without a clock
    std::uint32_t begin = 0;                 // of the window
    std::uint64_t settling = 0, window = 0;  // rays
};

// Hands the rays of one stretch after another to the machine, and makes them no earlier than they are wanted.
class StretchSupply final : public sim::RaySupply {
  public:
    StretchSupply(const RayPopulation& population, const WindowPlan& plan)
        : population_(population), plan_(plan) {
        const std::uint32_t size = population.size(), length = plan.window_length;
        const double share = double(size - 2 * std::uint64_t(length)) / plan.window_count;
        begins_.push_back(0);
        for (std::uint32_t k = 0; k < plan.window_count; ++k) {
            // At random: equal distances would meet the same columns of a picture again and again.
            model::RandomStream random(plan.seed, window_purpose, k);
            begins_.push_back(length + std::uint32_t(share * k + double(random.next()) * (share - length)));
        }
        begins_.push_back(size - length);
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
        stretch.window = part.rays.size() - before;
        const auto settling = part.rays.begin() + std::ptrdiff_t(before - stretch.settling);
        stretch.warm.assign(part.rays.begin(), settling);
        rays_.insert(rays_.end(), settling, part.rays.end());
    }

    const RayPopulation& population_;
    WindowPlan plan_;
    std::vector<std::uint32_t> begins_;
    std::deque<Stretch> stretches_;
    std::deque<model::Ray> rays_;
};

// One position of each `stride` of the middle, at random within it.
std::vector<std::uint32_t> lattice_positions(std::uint32_t size, const WindowPlan& plan) {
    std::vector<std::uint32_t> positions;
    const std::uint64_t end = size - plan.window_length;
    for (std::uint64_t begin = plan.window_length; begin < end; begin += plan.lattice_stride) {
        const std::uint64_t length = std::min<std::uint64_t>(plan.lattice_stride, end - begin);
        model::RandomStream random(plan.seed, lattice_purpose, std::uint32_t(begin));
        positions.push_back(std::uint32_t(begin + std::uint64_t(double(random.next()) * double(length))));
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
        : image_(image),
          population_(population),
          rtu_count_(config.rtu.count),
          length_(plan.window_length),
          supply_(population, plan),
          session_(config, image, supply_, population.kind()),
          lattice_(lattice_positions(population.size(), plan)) {}

    WindowMeasurement run() {
        result_.window_length = length_;
        result_.middle_length = population_.size() - 2 * std::uint64_t(length_);
        const std::size_t last = supply_.stretch_count() - 1;
        for (std::size_t i = 0; i <= last; ++i) {
            const WindowSample sample = measure(supply_.stretch(i), i == last);
            (i == 0 ? result_.first : i == last ? result_.last : result_.windows.emplace_back()) = sample;
        }
        trace_lattice(population_.size());
        return std::move(result_);
    }

  private:
    WindowSample measure(const Stretch& stretch, bool is_last) {
        trace_lattice(stretch.begin);
        for (const model::Ray& ray : stretch.warm) static_cast<void>(trace(ray));
        handed_ += stretch.settling;
        session_.advance_to(handed_);
        const sim::MachineMark begin = session_.mark();
        handed_ += stretch.window;
        if (is_last) {
            session_.finish();
        } else {
            session_.advance_to(handed_);
        }
        result_.simulated_rays += stretch.settling + stretch.window;
        return between(begin, session_.mark());
    }

    void trace_lattice(std::uint32_t end) {
        const auto stop = std::lower_bound(lattice_.begin() + std::ptrdiff_t(traced_), lattice_.end(), end);
        const std::span<const std::uint32_t> positions(lattice_.begin() + std::ptrdiff_t(traced_), stop);
        const PopulationPart part = population_.part(positions);
        std::size_t next = 0;
        for (const std::uint32_t position : positions) {
            const bool has_ray = next < part.positions.size() && part.positions[next] == position;
            result_.lattice.push_back(has_ray ? trace(part.rays[next++]) : RayWork{});
        }
        traced_ += positions.size();
    }

    // Without a clock, and its memory accesses into the caches.
    RayWork trace(const model::Ray& ray) {
        const std::uint32_t rtu = std::uint32_t(result_.traced_rays++ % rtu_count_);
        if (!walk_.start(image_, ray, population_.kind())) return walk_.work();
        do session_.warm(rtu, walk_.address(), walk_.size_bytes(image_));
        while (walk_.step(image_));
        return walk_.work();
    }

    const model::MemoryImage& image_;
    const RayPopulation& population_;
    std::uint32_t rtu_count_;
    std::uint32_t length_;
    StretchSupply supply_;
    sim::MachineSession session_;
    std::vector<std::uint32_t> lattice_;
    std::size_t traced_ = 0;  // of the lattice
    std::uint64_t handed_ = 0;
    FunctionalWalk walk_;
    WindowMeasurement result_;
};

}  // namespace

std::uint64_t simulated_length(const WindowPlan& plan) {
    return std::uint64_t(plan.window_count + 2) * (plan.window_length + plan.settling_rays);
}

WindowMeasurement measure_windows(const sim::Config& config, const model::MemoryImage& image,
                                  const RayPopulation& population, const WindowPlan& plan) {
    return Measuring(config, image, population, plan).run();
}

}  // namespace rtu::study
