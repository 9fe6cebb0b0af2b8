#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/error.hpp"
#include "study/sweep/sweep_database.hpp"
#include "study/sweep/sweep_figures.hpp"
#include "study/sweep/sweep_front.hpp"
#include "study/sweep/sweep_journal.hpp"
#include "study/sweep/sweep_table.hpp"
#include "tests/model/gltf_builder.hpp"

namespace rtu::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double rays_a_run = 1000, mhz = 1000;

// Sweeps whose points are given what they say.
class SweepFigures : public testing::Test {
  protected:
    void open(const std::string& text) {
        plan_ = make_sweep_plan(parse_sweep(text, "s.toml"));
        database_.emplace(folder_.path() / "s.db", SqlDatabase::Mode::ReadWrite);
        database_->set_plan(plan_);
        journal_.emplace(folder_.path() / "a.journal");
    }
    // A point's MRPS, exact or with an interval of cycles of `half` around it.
    void give(std::size_t point, double mrps, double half = 0, const std::string& level = "cycle") {
        SweepResult result;
        result.point = plan_.points.at(point).id;
        SweepRow row{"primary", level};
        const double cycles = rays_a_run * mhz / mrps;
        row.cycles_low = cycles * (1 - half);
        row.cycles_high = cycles * (1 + half);
        row.counts.resize(sweep_counts().size());
        row.counts[0] = std::uint64_t(rays_a_run);
        row.counts[6] = std::uint64_t(std::llround(cycles));
        if (level == "cycle")
            for (auto& count : row.counts) count = count.value_or(7);
        result.rows = {row, row};
        result.rows[1].workload = "total";
        journal_->add(to_json_line(result));
        static_cast<void>(database_->import_journals(folder_.path()));
    }
    [[nodiscard]] std::vector<SweepFigure> figures() const {
        return sweep_figures(database_->sql(), plan_.file.charts.at(0));
    }
    [[nodiscard]] std::vector<std::string> to_confirm(const std::set<std::string>& confirmed = {}) const {
        std::vector<std::string> slots;
        for (const std::string& id : front_to_confirm(rated_designs(database_->sql(), plan_.file.objectives),
                                                      confirmed, plan_.file.objectives)) {
            const auto design = std::ranges::find(plan_.designs, id, &SweepDesign::id);
            slots.push_back(fmt::format("{}", design->config.rtu.ray_slots));
        }
        return slots;
    }

    test::TemporaryFolder folder_;
    SweepPlan plan_;
    std::optional<SweepDatabase> database_;
    std::optional<JournalWriter> journal_;
};

// Of two scenes, whose best differs by a factor of ten.
TEST_F(SweepFigures, AgainstTheBestOfEachSceneIsAShareOfIt) {
    open(
        "scenes = [{ scene = \"builtin\", name = \"a\" }, { scene = \"builtin\", name = \"b\", seed = 2 }]\n"
        "[axes]\nrtu.ray_slots = [32, 64]\nrtu.box.boxes_per_cycle = [2, 4]\n"
        "[[charts]]\nname = \"c\"\ntitle = \"t\"\nx = \"rtu.ray_slots\"\nagainst = \"best\"\n");
    const double values[] = {40, 50, 100, 80, 400, 800, 900, 1000};
    for (std::size_t point = 0; point < 8; ++point) give(point, values[point]);
    const std::vector<SweepFigure> found = figures();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].x, "32");
    EXPECT_EQ(found[0].samples, 2U);
    EXPECT_NEAR(found[0].value, 100 * std::sqrt(0.5 * 0.8), 0.05);
    EXPECT_NEAR(found[0].least, 50, 0.05);
    EXPECT_NEAR(found[0].most, 80, 0.05);
    EXPECT_NEAR(found[1].least, 100, 1e-9);
    EXPECT_THAT(sweep_figure_table(plan_.file.charts[0], found), HasSubstr("63.2 (50.0..80.0)"));
}

TEST_F(SweepFigures, AgainstABaseEveryDesignIsComparedWithItsOwn) {
    open(
        "scenes = [\"builtin\"]\n[axes]\nrtu.ray_slots = [32, 64]\nrtu.box.boxes_per_cycle = [2, 4]\n"
        "[[charts]]\nname = \"c\"\ntitle = \"t\"\nx = \"workload\"\nagainst = { \"rtu.ray_slots\" = 32 }\n");
    const double values[] = {100, 10, 150, 20};
    for (std::size_t point = 0; point < 4; ++point) give(point, values[point]);
    const std::vector<SweepFigure> found = figures();
    ASSERT_EQ(found.size(), 1U) << "the bases themselves are not shown";
    EXPECT_EQ(found[0].x, "primary");
    EXPECT_EQ(found[0].samples, 2U);
    EXPECT_NEAR(found[0].least, 50, 0.05);
    EXPECT_NEAR(found[0].most, 100, 0.05);
    EXPECT_NEAR(found[0].value, 100 * (std::sqrt(1.5 * 2) - 1), 0.05);
}

TEST_F(SweepFigures, OfOneSceneTheIntervalIsShown) {
    open(
        "scenes = [\"builtin\"]\nfidelity = \"sampled\"\n[axes]\nrtu.ray_slots = [32, 64]\n"
        "[[charts]]\nname = \"c\"\ntitle = \"t\"\nx = \"rtu.ray_slots\"\n");
    give(0, 100, 0.2, "sampled");
    give(1, 50, 0.1, "sampled");
    EXPECT_NEAR(figures()[0].least, 100 / 1.2, 0.05);
    EXPECT_NEAR(figures()[0].most, 100 / 0.8, 0.05);
    const std::vector<std::size_t> exact{2};
    database_->add_points(plan_, exact);
    give(2, 90);
    const auto first = figures()[0];  // the simulation takes the estimate's place
    EXPECT_NEAR(first.value, 90, 0.05);
    EXPECT_DOUBLE_EQ(first.least, first.most);
}

TEST_F(SweepFigures, ChartsWithoutRowsAreErrors) {
    open(
        "scenes = [\"builtin\"]\n[[charts]]\nname = \"c\"\ntitle = \"t\"\nx = \"workload\"\nwhere = { preset "
        "= "
        "'none' }\n");
    give(0, 100);
    EXPECT_THROW(static_cast<void>(figures()), Error);
}

// The front as it looks is 256 alone; 128 may belong to it, because its interval reaches above what 256 has.
TEST_F(SweepFigures, WhatMayBeOnTheFrontIsSimulated) {
    open(
        "scenes = [\"builtin\"]\nfidelity = \"auto\"\nobjectives = [\"mrps\", \"max rtu.ray_slots\"]\n"
        "[axes]\nrtu.ray_slots = [32, 64, 128, 256]\n");
    ASSERT_EQ(plan_.points.size(), 8U);
    give(0, 50, 0.01, "analytic");
    give(1, 80, 0.01, "sampled");
    give(2, 99, 0.02, "sampled");
    give(3, 100, 0.02, "sampled");
    EXPECT_THAT(to_confirm(), ElementsAre("256"));
    const std::vector<std::size_t> exact{7};
    database_->add_points(plan_, exact);
    give(7, 100);
    EXPECT_THAT(to_confirm({plan_.designs[3].id}), ElementsAre("128")) << "98.9 to 101.0 may be above 100";
    const std::vector<std::size_t> more{6};
    database_->add_points(plan_, more);
    give(6, 99.5);
    EXPECT_THAT(to_confirm({plan_.designs[3].id, plan_.designs[2].id}), IsEmpty());
    const SweepConfirmation found = confirmation(database_->sql());
    EXPECT_EQ(found.designs, 2U);
    EXPECT_EQ(found.figures, 2U);
    EXPECT_EQ(found.inside, 2U);
    EXPECT_NEAR(found.largest_error_percent, 0.5, 0.05);
}

TEST_F(SweepFigures, AFigureOutsideItsIntervalIsCounted) {
    open("scenes = [\"builtin\"]\nfidelity = \"sampled\"\n");
    give(0, 100, 0.01, "sampled");
    const std::vector<std::size_t> exact{1};
    database_->add_points(plan_, exact);
    give(1, 110);
    EXPECT_EQ(confirmation(database_->sql()).inside, 0U);
    EXPECT_EQ(confirmation(database_->sql()).figures, 1U);
}

// A design that fails at cycle stays an estimate, and must not be asked for again and again.
TEST_F(SweepFigures, WhatFailedIsNotAskedForAgain) {
    open("scenes = [\"builtin\"]\nfidelity = \"sampled\"\n[axes]\nrtu.ray_slots = [32, 64]\n");
    give(0, 100, 0.01, "sampled");
    EXPECT_EQ(to_confirm().size(), 1U);
    EXPECT_THAT(to_confirm({plan_.designs[0].id}), IsEmpty());
}

TEST_F(SweepFigures, ATableHasARowAPointAndATypeAColumn) {
    open("scenes = [\"builtin\"]\nfidelity = \"sampled\"\n[axes]\nrtu.ray_slots = [32, 64]\n");
    give(0, 100, 0.01, "sampled");
    give(1, 50, 0.01, "sampled");
    const SweepTable table = sweep_table(database_->sql());
    ASSERT_EQ(table.rows.size(), 2U);
    const auto type_of = [&](const std::string& name) {
        const auto column = std::ranges::find(table.columns, name, &SweepColumn::name);
        return column == table.columns.end() ? "none" : std::string(to_string(column->type));
    };
    EXPECT_EQ(type_of("scene"), "string");
    EXPECT_EQ(type_of("rtu_ray_slots"), "int64");
    EXPECT_EQ(type_of("mgates"), "double");
    EXPECT_EQ(type_of("primary_cycles"), "int64");
    EXPECT_EQ(type_of("primary_l1_hits"), "int64") << "an estimate has none, the column keeps its type";
    EXPECT_EQ(type_of("primary_level"), "string");
    EXPECT_EQ(type_of("total_mrps_high"), "double");
    std::set<std::string> names;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        EXPECT_TRUE(names.insert(table.columns[i].name).second) << table.columns[i].name;
        EXPECT_EQ(table.columns[i].name.find('.'), std::string::npos);
        for (const std::vector<SqlValue>& row : table.rows) {
            if (std::holds_alternative<std::monostate>(row[i])) continue;
            EXPECT_EQ(row[i].index(), 1 + std::size_t(table.columns[i].type)) << table.columns[i].name;
        }
    }
}

}  // namespace
}  // namespace rtu::study
