#include "study/fidelity/ray_population.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace rtu::study {
namespace {

class PicturePopulation final : public RayPopulation {
  public:
    PicturePopulation(model::WorkloadKind kind, const model::WorkloadSetting& setting)
        : kind_(kind), setting_(setting), name_(to_string(kind)) {}

    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] model::RayKind kind() const override { return ray_kind(kind_); }
    [[nodiscard]] std::uint32_t size() const override {
        return setting_.resolution.width * setting_.resolution.height;
    }
    [[nodiscard]] std::uint32_t row_length() const override { return setting_.resolution.width; }
    [[nodiscard]] PopulationPart part(std::uint32_t begin, std::uint32_t end) const override {
        model::Workload made = make_workload(kind_, setting_, begin, end);
        return {std::move(made.rays), std::move(made.pixels)};
    }
    [[nodiscard]] PopulationPart part(std::span<const std::uint32_t> positions) const override {
        model::Workload made = make_workload(kind_, setting_, positions);
        return {std::move(made.rays), std::move(made.pixels)};
    }

  private:
    model::WorkloadKind kind_;
    model::WorkloadSetting setting_;
    std::string name_;
};

constexpr std::uint32_t guessed_row_length = 1024;  // of rays whose file names no picture

class StoredPopulation final : public RayPopulation {
  public:
    StoredPopulation(std::string name, model::RayKind kind, std::optional<std::uint32_t> rows)
        : name_(std::move(name)), kind_(kind), rows_(rows) {}

    void add(std::span<const model::Ray> rays) { rays_.insert(rays_.end(), rays.begin(), rays.end()); }

    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] model::RayKind kind() const override { return kind_; }
    [[nodiscard]] std::uint32_t size() const override { return std::uint32_t(rays_.size()); }
    [[nodiscard]] std::uint32_t row_length() const override {
        return rows_ ? std::max(1U, size() / *rows_) : guessed_row_length;
    }
    [[nodiscard]] PopulationPart part(std::uint32_t begin, std::uint32_t end) const override {
        PopulationPart part{{rays_.begin() + begin, rays_.begin() + end}, {}};
        part.positions.resize(end - begin);
        std::iota(part.positions.begin(), part.positions.end(), begin);
        return part;
    }
    [[nodiscard]] PopulationPart part(std::span<const std::uint32_t> positions) const override {
        PopulationPart part{{}, {positions.begin(), positions.end()}};
        for (const std::uint32_t position : positions) part.rays.push_back(rays_[position]);
        return part;
    }

  private:
    std::string name_;
    model::RayKind kind_;
    std::optional<std::uint32_t> rows_;  // of the picture, when there is one
    std::vector<model::Ray> rays_;
};

}  // namespace

std::unique_ptr<RayPopulation> picture_population(model::WorkloadKind kind,
                                                  const model::WorkloadSetting& setting) {
    return std::make_unique<PicturePopulation>(kind, setting);
}

std::vector<std::unique_ptr<RayPopulation>> file_populations(traces::RayReader& rays) {
    std::vector<std::unique_ptr<RayPopulation>> populations;
    StoredPopulation* last = nullptr;
    std::optional<std::uint32_t> rows;
    if (rays.header().picture) rows = rays.header().picture->resolution.height;
    for (std::optional<traces::RayChunk> chunk = rays.next(); chunk; chunk = rays.next()) {
        if (last == nullptr || last->name() != chunk->workload) {
            auto next = std::make_unique<StoredPopulation>(chunk->workload, chunk->kind, rows);
            last = next.get();
            populations.push_back(std::move(next));
        }
        last->add(chunk->rays);
    }
    return populations;
}

}  // namespace rtu::study
