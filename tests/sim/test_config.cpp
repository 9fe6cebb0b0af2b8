#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <variant>

#include "model/error.hpp"
#include "sim/effective_config.hpp"
#include "sim/presets.hpp"
#include "tests/sim/config_fixture.hpp"

namespace rtu::sim {
namespace {

using test::error_of;
using test::error_of_set;
using test::load_text;
using test::TemporaryFile;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

bool is_number(const ConfigKey& key) {
    return std::holds_alternative<std::uint32_t>(config_value(Config{}, key));
}

ConfigAssignment number(const ConfigKey& key, std::int64_t value) {
    return {std::string(key.name), value, {}, "test"};
}

TEST(ConfigKeys, NameEveryFieldOfTheStructOnce) {
    // Fields are 4 bytes wide or 1, so a number without a row leaves more room than padding takes.
    Config config;
    std::map<std::size_t, std::size_t> sizes{{sizeof(Config), 0}};  // by place
    for (const ConfigKey& key : config_keys()) {
        std::visit(
            [&](auto* field) {
                const auto* place = reinterpret_cast<const std::byte*>(field);
                sizes[std::size_t(place - reinterpret_cast<const std::byte*>(&config))] = sizeof(*field);
            },
            key.field(config));
    }
    EXPECT_EQ(sizes.size(), config_keys().size() + 1);
    std::size_t end = 0;
    for (const auto& [place, size] : sizes) {
        EXPECT_GE(place, end);
        EXPECT_LT(place - end, sizeof(std::uint32_t)) << "a field without a key before byte " << place;
        end = place + size;
    }
    for (const ConfigKey& key : config_keys()) {
        EXPECT_EQ(&key, &config_keys()[config_key_index(key.name, "test")]) << key.name;
    }
}

TEST(ConfigKeys, WriteTheirOwnFieldOnly) {
    for (const ConfigKey& key : config_keys()) {
        if (!is_number(key)) continue;
        const std::uint32_t before = std::get<std::uint32_t>(config_value(Config{}, key));
        const std::uint32_t after = before == key.max ? key.min : key.max;
        const EffectiveConfig changed = assign(default_config(), number(key, after));
        for (const ConfigKey& other : config_keys()) {
            const ConfigValue expected = &other == &key ? ConfigValue(after) : config_value(Config{}, other);
            EXPECT_EQ(config_value(changed.config, other), expected) << key.name << " and " << other.name;
        }
    }
}

TEST(ConfigKeys, AcceptBothEndsOfTheirRangeAndNothingBeyond) {
    for (const ConfigKey& key : config_keys()) {
        if (!is_number(key)) continue;
        EXPECT_NO_THROW((void)assign(default_config(), number(key, key.min))) << key.name;
        EXPECT_NO_THROW((void)assign(default_config(), number(key, key.max))) << key.name;
        EXPECT_THROW((void)assign(default_config(), number(key, std::int64_t(key.min) - 1)), Error)
            << key.name;
        EXPECT_THROW((void)assign(default_config(), number(key, std::int64_t(key.max) + 1)), Error)
            << key.name;
    }
}

TEST(ConfigKeys, RefuseNumbersOfTheWrongForm) {
    for (const ConfigKey& key : config_keys()) {
        if (key.form == ConfigKey::Form::Any) continue;
        EXPECT_THROW((void)assign(default_config(), number(key, std::int64_t(key.min) * 2 + 1)), Error)
            << key.name;
    }
}

TEST(ConfigKeys, AcceptEveryModeByItsName) {
    const ConfigKey& key = config_keys()[config_key_index("rtu.pair.mode", "test")];
    for (const std::string_view name : pair_mode_names()) {
        const EffectiveConfig changed =
            assign(default_config(), {"rtu.pair.mode", std::string(name), {}, "test"});
        EXPECT_EQ(config_value_text(changed.config, key), name);
    }
    EXPECT_EQ(pair_mode_names()[std::size_t(PairMode::Single)], "single");
    EXPECT_EQ(pair_mode_names()[std::size_t(PairMode::DualIndependent)], "dual_independent");
    EXPECT_EQ(pair_mode_names()[std::size_t(PairMode::DualShared)], "dual_shared");
}

TEST(ConfigKeys, AcceptEveryMemoryModelByItsName) {
    const EffectiveConfig flat = load_config("default", {}, std::vector<std::string>{"memory.model=flat"});
    EXPECT_EQ(flat.config.memory.model, MemoryModel::Flat);
    EXPECT_EQ(default_config().config.memory.model, MemoryModel::Dram);
    EXPECT_EQ(describe_config(load_text(describe_config(flat))), describe_config(flat));
    EXPECT_THAT(error_of_set("memory.model=sram"),
                AllOf(HasSubstr("--set memory.model=sram: "), HasSubstr("dram or flat")));
    EXPECT_THAT(error_of_set("memory.model=1"), HasSubstr("dram or flat"));
    EXPECT_THAT(error_of_set("memory.bytes_per_cycle=0"), HasSubstr("from 1 to 1024"));
}

TEST(Presets, AreValidAndSayWhereTheirValuesComeFrom) {
    for (const std::string& name : preset_names()) {
        const EffectiveConfig preset = load_config(name, {}, {});
        for (std::size_t i = 0; i < config_keys().size(); ++i) {
            const std::string& source = preset.origins[i].source;
            EXPECT_TRUE(source.starts_with("assumed: ") || source.starts_with("chosen: ") ||
                        source.starts_with("["))
                << name << ": " << config_keys()[i].name << ": " << source;
        }
    }
}

// What stays assumed of the RTU with its L1, beside the memory's technology and the host's link.
TEST(Presets, AssumeOfTheDefaultRtuOnlyWhatTheRtlLeavesOpen) {
    const EffectiveConfig machine = default_config();
    std::vector<std::string_view> assumed;
    for (std::size_t i = 0; i < config_keys().size(); ++i) {
        const std::string_view key = config_keys()[i].name;
        if (key == "rtu.box.dequantise_cycles") continue;  // the RTL has full nodes, as this machine
        const bool is_outside = key.starts_with("l2.") || key.starts_with("dram.") ||
                                key.starts_with("memory.") || key.starts_with("link.");
        const std::string& source = machine.origins[i].source;
        if (!is_outside && source.starts_with("assumed: ")) assumed.push_back(key);
        const bool is_timing =
            key.starts_with("rtu.") && (key.ends_with("_cycles") || key.ends_with("s_per_cycle"));
        if (is_timing && key != "rtu.pair.replay_cycles" && key != "rtu.box.boxes_per_cycle") {
            EXPECT_THAT(source, testing::StartsWith("[rtl] ")) << key;
        }
    }
    EXPECT_THAT(assumed, testing::ElementsAre("rtu.pair.replay_cycles", "l1.targets_per_mshr"));
}

TEST(Presets, CallAssumedWhatTheyTakeOverFromTheDefaultMachine) {
    const EffectiveConfig preset = load_config("xe_hpg", {}, {});
    const std::size_t row_bytes = config_key_index("dram.row_bytes", "test");
    ASSERT_FALSE(default_config().origins[row_bytes].source.starts_with("assumed"));
    EXPECT_THAT(preset.origins[row_bytes].source, testing::StartsWith("assumed: as default"));
    EXPECT_EQ(preset.origins[config_key_index("clock_mhz", "test")].source, "[a770] graphics clock");
}

TEST(Presets, BeginWithTheDefaultMachine) {
    ASSERT_EQ(preset_names().front(), "default");
    EXPECT_EQ(describe_config(load_config("default", {}, {})), describe_config(default_config()));
    EXPECT_THAT(preset_names(), AllOf(Contains("xe_hpg"), Contains("rdna4"), Contains("cxt")));
}

TEST(Presets, TestWholeNodesAtTheirPublishedRates) {
    const Config xe = load_config("xe_hpg", {}, {}).config;
    EXPECT_EQ(xe.rtu.box.boxes_per_cycle, 2 * xe.bvh.width);  // two traversal pipelines
    const Config rdna = load_config("rdna4", {}, {}).config;
    EXPECT_EQ(rdna.rtu.box.boxes_per_cycle, rdna.bvh.width);  // one node a cycle
    EXPECT_EQ(rdna.rtu.pair.mode, PairMode::DualIndependent);
}

TEST(Presets, UnknownNameListsTheKnownOnes) {
    const std::string error = error_of([] { (void)load_config("xe_hgp", {}, {}); });
    EXPECT_THAT(error, HasSubstr("xe_hgp"));
    for (const std::string& name : preset_names()) EXPECT_THAT(error, HasSubstr(name));
}

TEST(EffectiveConfig, PrintsAsAFileThatGivesTheSameValuesAndSources) {
    const std::vector<std::string> sets{"rtu.pair.mode=dual_independent", "l1.latency_cycles=7"};
    for (const std::string& name : preset_names()) {
        const std::string text = describe_config(load_config(name, {}, sets));
        EXPECT_EQ(describe_config(load_text(text)), text) << name;
    }
}

TEST(EffectiveConfig, PrintsSourcesWithQuotesAndControlCharacters) {
    EffectiveConfig config = default_config();
    config.origins[0].source = "a \"quoted\" \\ word,\na new line, \x7f";
    EXPECT_EQ(load_text(describe_config(config)).origins[0].source, config.origins[0].source);
}

TEST(EffectiveConfig, LetsFilesOverridePresetsAndOptionsOverrideFiles) {
    const TemporaryFile file("rtu.ray_slots = 5\n[bvh]\nwidth = { value = 2, source = \"[x]\" }\n");
    const EffectiveConfig config =
        load_config("xe_hpg", file.path(), std::vector<std::string>{"bvh.width = 8"});
    EXPECT_EQ(config.config.rtu.ray_slots, 5U);
    EXPECT_EQ(config.origins[config_key_index("rtu.ray_slots", "")].source, file.path().string() + ":1");
    EXPECT_EQ(config.config.bvh.width, 8U);
    EXPECT_EQ(config.origins[config_key_index("bvh.width", "")].source, "set by option");
    EXPECT_EQ(config.config.rtu.box.boxes_per_cycle,
              load_config("xe_hpg", {}, {}).config.rtu.box.boxes_per_cycle);
}

TEST(EffectiveConfig, KeepsTheSourceThatAFileGives) {
    const EffectiveConfig config =
        load_text("[rtu.box]\nboxes_per_cycle = { value = 12, source = \"a page\" }");
    EXPECT_EQ(config.config.rtu.box.boxes_per_cycle, 12U);
    EXPECT_EQ(config.origins[config_key_index("rtu.box.boxes_per_cycle", "")].source, "a page");
}

std::string machine_page() {
    std::ifstream stream(std::filesystem::path(RTUSIM_SOURCE_DIR) / "docs/machine.md");
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

TEST(MachinePage, HoldsTheTablesThatTheProgramPrints) {
    const std::string page = machine_page();
    EXPECT_TRUE(page.find(config_markdown(default_config())) != std::string::npos)
        << "docs/machine.md needs this table:\n"
        << config_markdown(default_config());
    EXPECT_TRUE(page.find(presets_markdown()) != std::string::npos) << "docs/machine.md needs this table:\n"
                                                                    << presets_markdown();
}

/// The keys in square brackets in `text`.
std::vector<std::string> citations(std::string_view text) {
    std::vector<std::string> found;
    for (std::size_t begin = text.find('['); begin != std::string_view::npos;
         begin = text.find('[', begin + 1)) {
        found.emplace_back(text.substr(begin, text.find(']', begin) + 1 - begin));
    }
    return found;
}

void expect_sources_listed(const std::string& page, const std::string& name, const EffectiveConfig& config) {
    for (const EffectiveConfig::Origin& origin : config.origins) {
        for (const std::string& key : citations(origin.source)) {
            EXPECT_TRUE(page.find("- **" + key + "** ") != std::string::npos) << name << " cites " << key;
        }
    }
}

TEST(MachinePage, ListsEverySourceThatAPresetOrALinkCites) {
    const std::string page = machine_page();
    for (const std::string& name : preset_names())
        expect_sources_listed(page, name, load_config(name, {}, {}));
    for (const std::string& name : link_names())
        expect_sources_listed(page, name, load_config("default", {}, {}, name));
}

TEST(Links, ChangeKeysOfTheLinkOnlyAndGiveTheirSources) {
    const EffectiveConfig without = load_config("rdna4", {}, {}, "none");
    EXPECT_EQ(without.config.link.count, 0U);
    ASSERT_GE(embedded_links().size(), 5U);
    for (const EmbeddedPreset& link : embedded_links()) {
        const EffectiveConfig with = load_config("rdna4", {}, {}, link.name);
        EXPECT_EQ(with.config.link.count, 1U);
        for (std::size_t i = 0; i < config_keys().size(); ++i) {
            const ConfigKey& key = config_keys()[i];
            if (key.name.starts_with("link.")) continue;
            EXPECT_EQ(config_value(with.config, key), config_value(without.config, key)) << key.name;
            EXPECT_EQ(with.origins[i].source, without.origins[i].source);
        }
        EXPECT_FALSE(with.origins[config_key_index("link.up_mb_per_second", "")].source.empty());
    }
}

TEST(Links, ComeAfterThePresetAndBeforeFileAndOptions) {
    const TemporaryFile file("[link]\nlatency_ns = 7\noverhead_ns = 8\n");
    const std::vector<std::string> sets{"link.overhead_ns=9"};
    const Config::Link link = load_config("default", file.path(), sets, "agp_8x").config.link;
    EXPECT_EQ(link.down_mb_per_second, 250U);
    EXPECT_EQ(link.latency_ns, 7U);
    EXPECT_EQ(link.overhead_ns, 9U);
}

TEST(Links, UnknownOnesAreErrorsThatNameTheKnown) {
    EXPECT_EQ(error_of([] { (void)load_config("default", {}, {}, "pcie9"); }),
              "link: expected one of none, agp_8x, pcie3_x16, pcie4_x16, pcie5_x16, on_chip, got 'pcie9'");
}

}  // namespace
}  // namespace rtu::sim
