#include "study/sweep/sweep_designs.hpp"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <optional>
#include <set>
#include <utility>

#include "model/error.hpp"
#include "model/fingerprint.hpp"
#include "model/random.hpp"
#include "sim/config_keys.hpp"
#include "study/area/area_model.hpp"
#include "study/area/area_objective.hpp"

namespace rtu::study {
namespace {

constexpr std::uint64_t most_designs = 1'000'000;

// Where a design stands on each axis of the grid: preset, pairing, then the file's axes.
using GridPlace = std::vector<std::size_t>;

std::vector<std::size_t> axis_sizes(const SweepFile& file) {
    std::vector<std::size_t> sizes{file.presets.size(), file.pairings.size()};
    for (const SweepAxis& axis : file.axes) sizes.push_back(axis.settings.size());
    return sizes;
}

std::string design_id(const SweepDesign& design, model::EdgeIdentity identity) {
    std::string text = fmt::format("{} {}\n", to_string(design.pairing), model::to_string(identity));
    for (const sim::ConfigKey& key : sim::config_keys()) {
        text += fmt::format("{}={}\n", key.name, config_value_text(design.config, key));
    }
    return model::hex_digits(model::fingerprint(text));
}

std::vector<std::string> changes(const sim::Config& from, const sim::Config& to) {
    std::vector<std::string> sets;
    for (const sim::ConfigKey& key : sim::config_keys()) {
        const std::string value = config_value_text(to, key);
        if (value != config_value_text(from, key)) sets.push_back(fmt::format("{}={}", key.name, value));
    }
    return sets;
}

// Makes the designs of places on the grid.
class DesignMaker {
  public:
    explicit DesignMaker(const SweepFile& file) : file_(file) {
        for (const std::string& name : file.presets) {
            sim::EffectiveConfig config = sim::load_config(name, {}, {});
            presets_.push_back(config.config);
            for (const auto& fixed : file.fixed) config = sim::assign(std::move(config), fixed);
            bases_.push_back(std::move(config));
        }
    }

    // Nothing for a design that a constraint rules out.
    [[nodiscard]] std::optional<SweepDesign> make(const GridPlace& place) const {
        sim::EffectiveConfig effective = bases_[place[0]];
        for (std::size_t i = 0; i < file_.axes.size(); ++i) {
            for (const auto& assignment : file_.axes[i].settings[place[i + 2]]) {
                effective = sim::assign(std::move(effective), assignment);
            }
        }
        for (const SweepConstraint& constraint : file_.constraints) {
            if (!constraint.holds(effective.config)) return std::nullopt;
        }
        check(effective);
        SweepDesign design{{},
                           file_.presets[place[0]],
                           file_.pairings[place[1]],
                           effective.config,
                           changes(presets_[place[0]], effective.config)};
        design.id = design_id(design, file_.edge_identity);
        return design;
    }

  private:
    static void check(const sim::EffectiveConfig& effective) {
        try {
            sim::validate(effective);
        } catch (const Error& error) {
            throw Error("{} (a constraint can leave such designs out)", error.what());
        }
    }

    const SweepFile& file_;
    std::vector<sim::Config> presets_;
    std::vector<sim::EffectiveConfig> bases_;  // presets with what [set] says
};

std::vector<SweepDesign> whole_grid(const SweepFile& file, const DesignMaker& maker) {
    const std::vector<std::size_t> sizes = axis_sizes(file);
    std::vector<SweepDesign> designs;
    std::set<std::string> ids;
    GridPlace place(sizes.size(), 0);
    std::size_t axis = 0;
    do {
        std::optional<SweepDesign> design = maker.make(place);
        if (design && ids.insert(design->id).second) designs.push_back(std::move(*design));
        for (axis = sizes.size(); axis > 0 && ++place[axis - 1] == sizes[axis - 1]; --axis) {
            place[axis - 1] = 0;
        }
    } while (axis > 0);
    return designs;
}

// Uniform 64-bit numbers, one for each axis of a place: independent, or a Sobol sequence [JK08] whose bits
// are flipped by a mask of the seed, which keeps its evenness.
class PlaceSource {
  public:
    PlaceSource(const SweepSubset& subset, std::vector<std::size_t> sizes)
        : subset_(subset), sizes_(std::move(sizes)), sobol_(sizes_.size()) {}

    GridPlace next() {
        GridPlace place;
        for (std::size_t axis = 0; axis < sizes_.size(); ++axis) {
            const std::uint64_t bits = subset_.method == SweepSubset::Method::Sobol
                                           ? sobol_() ^ random(axis, 0)
                                           : random(axis, index_ + 1);
            place.push_back(std::size_t(((bits >> 32) * sizes_[axis]) >> 32));
        }
        ++index_;
        return place;
    }

  private:
    [[nodiscard]] std::uint64_t random(std::size_t axis, std::uint64_t index) const {
        const auto words =
            model::philox({std::uint32_t(axis), std::uint32_t(index), std::uint32_t(index >> 32), 0},
                          {std::uint32_t(subset_.seed), std::uint32_t(subset_.seed >> 32)});
        return std::uint64_t{words[0]} << 32 | words[1];
    }

    const SweepSubset& subset_;
    std::vector<std::size_t> sizes_;
    boost::random::sobol sobol_;
    std::uint64_t index_ = 0;
};

std::vector<SweepDesign> sampled(const SweepFile& file, const DesignMaker& maker) {
    const SweepSubset& subset = *file.subset;
    PlaceSource places(subset, axis_sizes(file));
    std::set<GridPlace> seen;
    std::vector<std::pair<GridPlace, SweepDesign>> chosen;
    std::set<std::string> ids;
    const std::uint64_t most_tries = 100 * subset.designs + 10'000;
    for (std::uint64_t tries = 0; chosen.size() < subset.designs; ++tries) {
        if (tries == most_tries) {
            throw Error("{}: expected {} designs that meet all constraints, found {} in {} tries",
                        subset.place, subset.designs, chosen.size(), most_tries);
        }
        GridPlace place = places.next();
        if (!seen.insert(place).second) continue;
        std::optional<SweepDesign> design = maker.make(place);
        if (design && ids.insert(design->id).second)
            chosen.emplace_back(std::move(place), std::move(*design));
    }
    std::ranges::sort(chosen, {}, [](const auto& entry) { return entry.first; });
    std::vector<SweepDesign> result;
    result.reserve(chosen.size());
    for (auto& entry : chosen) result.push_back(std::move(entry.second));
    return result;
}

}  // namespace

std::uint64_t grid_size(const SweepFile& file) {
    std::uint64_t product = 1;
    for (const std::size_t size : axis_sizes(file)) {
        if (__builtin_mul_overflow(product, std::uint64_t(size), &product)) return UINT64_MAX;
    }
    return product;
}

std::vector<SweepDesign> sweep_designs(const SweepFile& file) {
    const std::uint64_t size = grid_size(file);
    const bool is_sampled = file.subset && file.subset->designs < size;
    if (!is_sampled && size > most_designs) {
        throw Error("{}: expected at most {} designs, got {}{}: a subset takes a part of them",
                    file.axes.front().place, most_designs, size, size == UINT64_MAX ? " or more" : "");
    }
    const DesignMaker maker(file);
    std::vector<SweepDesign> designs = is_sampled ? sampled(file, maker) : whole_grid(file, maker);
    if (designs.empty())
        throw Error("{}: expected a design that meets all constraints, found none", file.name);
    return designs;
}

DesignArea design_area(const sim::Config& config) {
    return {machine_gates(config) / 1e6, total(rtu_area(config)).sram_bits * config.rtu.count / 1e6};
}

}  // namespace rtu::study
