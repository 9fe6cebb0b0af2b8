#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "model/error.hpp"
#include "study/sweep/sweep_designs.hpp"
#include "tests/model/gltf_builder.hpp"

namespace rtu::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string head = "scenes = [\"builtin\"]\n";

std::vector<SweepDesign> designs(const std::string& text) {
    return sweep_designs(parse_sweep(head + text, "s.toml"));
}

std::string error_of(const std::string& text) {
    try {
        static_cast<void>(designs(text));
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

template <class Member>
std::vector<std::uint32_t> values(const std::string& text, Member member) {
    std::vector<std::uint32_t> result;
    for (const SweepDesign& design : designs(text)) result.push_back(member(design.config));
    return result;
}

std::uint32_t slots(const sim::Config& config) { return config.rtu.ray_slots; }
std::uint32_t boxes(const sim::Config& config) { return config.rtu.box.boxes_per_cycle; }

TEST(SweepFile, DefaultsAreThoseOfARun) {
    const SweepFile file = parse_sweep(head, "folder/boxes.toml");
    EXPECT_EQ(file.name, "boxes");
    EXPECT_EQ(file.workloads.size(), 3U);
    EXPECT_EQ(file.resolution.width, 256U);
    EXPECT_EQ(file.presets, std::vector<std::string>{"default"});
    EXPECT_EQ(file.objectives.size(), 2U);
    EXPECT_EQ(sweep_designs(file).size(), 1U);
}

TEST(SweepFile, AListARangeAndALogarithmicRange) {
    EXPECT_THAT(values("[axes]\nrtu.ray_slots = [8, 3, 5]\n", slots), ElementsAre(8, 3, 5));
    EXPECT_THAT(values("[axes]\nrtu.ray_slots = { from = 2, to = 9, step = 3 }\n", slots),
                ElementsAre(2, 5, 8));
    EXPECT_THAT(values("[axes]\nrtu.ray_slots = { from = 4, to = 32, factor = 2 }\n", slots),
                ElementsAre(4, 8, 16, 32));
    EXPECT_THAT(values("[axes]\nrtu.ray_slots = { from = 1, to = 5, factor = 1.5 }\n", slots),
                ElementsAre(1, 2, 3, 5));  // 1, 1.5, 2.25, 3.4, 5.06: each rounded once
}

TEST(SweepFile, TheLastAxisIsTheFastest) {
    const auto both = [](const sim::Config& config) { return slots(config) * 100 + boxes(config); };
    EXPECT_THAT(values("[axes]\nrtu.ray_slots = [1, 2]\nrtu.box.boxes_per_cycle = [4, 8]\n", both),
                ElementsAre(104, 108, 204, 208));
}

TEST(SweepFile, LinkedKeysChangeTogether) {
    const auto both = [](const sim::Config& config) { return config.rtu.count * 100 + config.dram.channels; };
    EXPECT_THAT(values("[[linked]]\nrtu.count = [1, 2, 3]\ndram.channels = [4, 8, 16]\n", both),
                ElementsAre(104, 208, 316));
    EXPECT_THAT(values("[[linked]]\nrtu.count = [1, 2, 2]\ndram.channels = [4, 4, 8]\n", both),
                ElementsAre(104, 204, 208));
}

TEST(SweepFile, ConstraintsLeaveDesignsOut) {
    const std::string axes = "[axes]\nrtu.ray_slots = [8, 16, 32, 64]\n";
    const auto with = [&](const std::string& constraint) {
        return values("constraints = [\"" + constraint + "\"]\n" + axes, slots);
    };
    EXPECT_THAT(with("rtu.ray_slots < 16"), ElementsAre(8));
    EXPECT_THAT(with("rtu.ray_slots <= 2 * (rtu.box.boxes_per_cycle + 4)"), ElementsAre(8, 16));
    EXPECT_THAT(with("rtu.ray_slots / 64 + 0 == 1"), ElementsAre(64));
    EXPECT_THAT(with("10 - 2 - 3 >= rtu.ray_slots / 8 + 1"), ElementsAre(8, 16, 32));
    EXPECT_THAT(with("rtu.ray_slots != 16"), ElementsAre(8, 32, 64));
    // Where there is no number, nothing holds.
    EXPECT_THAT(error_of("constraints = [\"rtu.ray_slots < 1 / (bvh.width - 4)\"]\n"),
                HasSubstr("found none"));
}

TEST(SweepFile, AConstraintComparesNames) {
    const std::string axes = "[axes]\nrtu.pair.mode = ['single', 'dual_shared']\n";
    EXPECT_EQ(designs("constraints = [\"rtu.pair.mode == 'single'\"]\n" + axes).size(), 1U);
    EXPECT_EQ(designs("constraints = [\"rtu.pair.mode != 'dual_independent'\"]\n" + axes).size(), 2U);
}

TEST(SweepFile, EqualDesignsComeOnce) {
    EXPECT_EQ(designs("presets = [\"default\", \"rdna4\"]\n").size(), 2U);
    EXPECT_EQ(designs("presets = [\"cxt\", \"pairing_paper\"]\n[set]\nrtu.pair.ii_cycles = 2\n").size(), 1U);
    EXPECT_EQ(designs("pairings = [\"none\", \"edge_bbsa\"]\n").size(), 2U);
}

TEST(SweepFile, ASubsetMeetsAllConstraintsAndIsTheSameEveryTime) {
    const std::string axes =
        "[axes]\nrtu.ray_slots = { from = 1, to = 100, step = 1 }\nrtu.box.boxes_per_cycle = { from = 1, to "
        "= "
        "64, step = 1 }\nrtu.box.latency_cycles = { from = 1, to = 1000, step = 1 }\n";
    for (const char* method : {"random", "sobol"}) {
        const auto ids = [&](const char* seed) {
            const auto found =
                designs(std::string("constraints = [\"rtu.ray_slots > 50\"]\nsubset = { method = \"") +
                        method + "\", designs = 64, seed = " + seed + " }\n" + axes);
            std::set<std::string> result;
            for (const SweepDesign& design : found) {
                EXPECT_GT(slots(design.config), 50U);
                result.insert(design.id);
            }
            return result;
        };
        EXPECT_EQ(ids("1").size(), 64U);
        EXPECT_EQ(ids("1"), ids("1"));
        EXPECT_NE(ids("1"), ids("2"));
    }
}

// Of 64 points of a Sobol sequence every 64th of an axis has exactly one; of random ones that is hopeless.
TEST(SweepFile, ASobolSubsetIsEven) {
    const auto distinct = [](const char* method) {
        const std::string subset =
            std::string("subset = { method = \"") + method + "\", designs = 64, seed = 9 }\n";
        std::set<std::uint32_t> latencies;
        for (const SweepDesign& design : designs(
                 subset +
                 "[axes]\nrtu.ray_slots = { from = 1, to = 64, step = 1 }\nrtu.box.latency_cycles = { from = "
                 "1, to = 64, step = 1 }\n")) {
            latencies.insert(design.config.rtu.box.latency_cycles);
        }
        return latencies.size();
    };
    EXPECT_GE(distinct("sobol"), 63U);  // the sequence leaves its first point, zero, out
    EXPECT_LT(distinct("random"), 55U);
}

TEST(SweepFile, AnEmptySubsetIsAnError) {
    EXPECT_THAT(
        error_of("constraints = [\"rtu.ray_slots > 99\"]\nsubset = { method = \"random\", designs = 9 }\n"
                 "[axes]\nrtu.ray_slots = { from = 1, to = 90, step = 1 }\n"),
        HasSubstr("s.toml:3: expected 9 designs that meet all constraints, found 0"));
    EXPECT_THAT(error_of("constraints = [\"rtu.ray_slots > 999\"]\n"), HasSubstr("found none"));
}

struct BadFile {
    const char* text;
    const char* error;
};

class SweepFileErrors : public testing::TestWithParam<BadFile> {};

TEST_P(SweepFileErrors, NameFileAndLine) {
    EXPECT_THAT(error_of(GetParam().text), testing::StartsWith(GetParam().error));
}

const BadFile bad_files[] = {
    {"axis = 1\n", "s.toml:2: expected one of scenes, workloads, "},
    {"[axes]\nrtu.ray_slot = [1]\n",
     "s.toml:3: expected a configuration key, got 'rtu.ray_slot'; did you mean 'rtu.ray_slots'?"},
    {"[axes]\nrtu.box = {}\n", "s.toml:3: expected a configuration key, got 'rtu.box'"},
    {"[axes]\nrtu.ray_slots = [1, 0]\n",
     "s.toml:3: rtu.ray_slots: expected a number from 1 to 4096 rays, got 0"},
    {"[axes]\nrtu.ray_slots = [1, 1]\n", "s.toml:3: rtu.ray_slots: expected every value once"},
    {"[[linked]]\nrtu.ray_slots = [1, 1, 1]\nbvh.width = [2, 4, 2]\n",
     "s.toml:3: rtu.ray_slots: expected every combination of linked values once"},
    {"[axes]\nrtu.ray_slots = []\n", "s.toml:3: rtu.ray_slots: expected 1 to 65536 values, got none"},
    {"[axes]\nrtu.ray_slots = 5\n", "s.toml:3: expected rtu.ray_slots: a list of values, or"},
    {"[axes]\nrtu.ray_slots = [1.5]\n", "s.toml:3: expected rtu.ray_slots: a whole number or a name"},
    {"[axes]\nrtu.ray_slots = { from = 1, to = 9 }\n",
     "s.toml:3: rtu.ray_slots: expected { from, to, step }"},
    {"[axes]\nrtu.ray_slots = { from = 1, to = 9, step = 0 }\n", "s.toml:3: expected rtu.ray_slots: step"},
    {"[axes]\nrtu.ray_slots = { from = 1, to = 9, factor = 1 }\n", "s.toml:3: expected a factor"},
    {"[axes]\nrtu.ray_slots = { from = 9, to = 1, step = 1 }\n", "s.toml:3: expected rtu.ray_slots: to"},
    {"[axes]\nrtu.pair.mode = ['double']\n", "s.toml:3: rtu.pair.mode: expected single, "},
    {"[set]\nrtu.ray_slots = 4\n[axes]\nrtu.ray_slots = [1]\n", "s.toml:5: expected every key in one place"},
    {"[[linked]]\nrtu.count = [1, 2]\ndram.channels = [1]\n",
     "s.toml:4: dram.channels: expected 2 values, as of the key linked with it, got 1"},
    {"[axes]\nl1.size_bytes = [65536, 49152]\n",
     "s.toml:3: expected a capacity of a power of two sets (size / line / ways), got l1.size_bytes = 49152"},
    {"presets = [\"rdna5\"]\n", "s.toml:2: "},
    {"workloads = [\"primary\", \"primary\"]\n", "s.toml:2: expected every name once, got 'primary' again"},
    {"workloads = [\"tertiary\"]\n", "s.toml:2: "},
    {"pairings = [\"all\"]\n", "s.toml:2: "},
    {"resolution = [0, 4]\n", "s.toml:2: expected a width in pixels, a number from 1 to 16384, got 0"},
    {"resolution = [4]\n", "s.toml:2: expected resolution = [width, height]"},
    {"camera = \"none.toml\"\n", "s.toml:2: none.toml: "},
    {"fidelity = \"magic\"\n", "s.toml:2: expected counts, analytic, sampled, cycle or auto, got 'magic'"},
    {"fidelity = \"rtl\"\n", "s.toml:2: expected counts, analytic, sampled, cycle or auto, got 'rtl'"},
    {"fidelity = \"sampled\"\ntolerance = 0.1\n", "s.toml:3: expected tolerance, a number from 0.6"},
    {"tolerance = 2\n", "s.toml:2: a tolerance is of fidelity sampled and auto only"},
    {"fidelity = \"auto\"\nobjectives = [\"bytes_per_ray\"]\n",
     "s.toml:3: bytes_per_ray needs fidelity cycle"},
    {"[[charts]]\nname = \"a\"\n", "s.toml:2: a chart needs title"},
    {"[[charts]]\nname = \"a b\"\n", "s.toml:3: expected a chart's name"},
    {"[[charts]]\nname = \"a\"\ntitle = \"\"\nx = \"rtu.slots\"\n", "s.toml:5: expected a configuration key"},
    {"[[charts]]\nname = \"a\"\ntitle = \"\"\nx = \"scene\"\ny = \"speed\"\n",
     "s.toml:6: expected one of mrps"},
    {"[[charts]]\nname = \"a\"\ntitle = \"\"\nx = \"scene\"\nagainst = \"all\"\n",
     "s.toml:6: expected against = 'best'"},
    {"objectives = [\"speed\"]\n", "s.toml:2: expected an objective (mrps, "},
    {"objectives = [\"min rtu.pair.mode\"]\n", "s.toml:2: expected an objective that is a number"},
    {"subset = { method = \"halton\", designs = 3 }\n", "s.toml:2: expected sobol or random, got 'halton'"},
    {"subset = { designs = 3 }\n", "s.toml:2: expected subset = "},
    {"constraints = [\"rtu.ray_slots\"]\n", "s.toml:2: constraint 'rtu.ray_slots': expected a comparison"},
    {"constraints = [\"1 < (2\"]\n", "s.toml:2: constraint '1 < (2': expected ')', got its end"},
    {"constraints = [\"1 < 2 3\"]\n", "s.toml:2: constraint '1 < 2 3': expected nothing more, got '3'"},
    {"constraints = [\"1 < rtu.pair.mode\"]\n", "s.toml:2: constraint"},
    {"constraints = [\"rtu.pair.mode == 'tripple'\"]\n", "s.toml:2: constraint"},
    {"constraints = [\"1 < bvh.widht\"]\n", "s.toml:2: expected a configuration key, got 'bvh.widht'"},
    {"seed = = 3\n", "s.toml:2: expected TOML, got"},
};
INSTANTIATE_TEST_SUITE_P(All, SweepFileErrors, testing::ValuesIn(bad_files));

TEST(SweepFile, ScenesMustBeThere) {
    const auto fault = [](const std::string& text) {
        try {
            static_cast<void>(parse_sweep(text, "s.toml"));
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_THAT(fault(""), HasSubstr("s.toml:1: expected scenes"));
    EXPECT_THAT(fault("\nscenes = []"), HasSubstr("s.toml:2: scenes: expected at least one"));
    EXPECT_THAT(fault("scenes = [\"gone.glb\"]"), HasSubstr("s.toml:1: gone.glb: "));
    EXPECT_THAT(fault("scenes = [\"builtin\", \"builtin\"]"), HasSubstr("two scenes are called 'builtin'"));
    EXPECT_THAT(fault("scenes = [{ scene = \"builtin\", kind = \"any\" }]"), HasSubstr("got no rays"));
    EXPECT_THAT(fault("scenes = [{ rays = \"a.npy\" }]"), HasSubstr("got no scene"));
}

}  // namespace
}  // namespace rtu::study
