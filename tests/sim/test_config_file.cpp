#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/sim/config_fixture.hpp"

namespace rtu::sim {
namespace {

using test::error_of;
using test::error_of_set;
using test::error_of_text;
using test::load_text;
using testing::AllOf;
using testing::HasSubstr;

TEST(ConfigFile, EmptyChangesNothing) {
    for (const std::string_view text : {"", "\n", "# nothing\n", "[rtu]\n[rtu.pair]\n"}) {
        EXPECT_EQ(describe_config(load_text(text)), describe_config(default_config())) << text;
    }
}

struct BadText {
    std::string_view text;
    std::string_view where;  // after the file's name
    std::string_view what;
};

TEST(ConfigFile, NamesTheLineOfEveryMistake) {
    const BadText cases[] = {
        {"clock_mhz = 1\n\nrtu.contu = 3\n", ":3: ", "did you mean 'rtu.count'?"},
        {"[rtu.bx]\nlatency_cycles = 3\n", ":2: ", "did you mean 'rtu.box.latency_cycles'?"},
        {"\nboxes_per_cycle = 3\n", ":2: ", "did you mean 'rtu.box.boxes_per_cycle'?"},
        {"\n[nothing_like_it]\n", ":2: ", "got 'nothing_like_it'"},
        {"\"\" = 1\n", ":1: ", "got ''"},
        {"rtu = 3\n", ":1: ", "got 'rtu'"},
        {"rtu.count = 1\n\nrtu.count = 1\n", ":3: ", "redefine"},
        {"[rtu]\ncount = 1\n[rtu]\n", ":3: ", "redefine"},
        {"[rtu]\ncount = 0\n", ":2: ", "from 1 to 64 RTUs, got 0"},
        {"\nrtu.count = -1\n", ":2: ", "got -1"},
        {"rtu.count = 4294967297\n", ":1: ", "got 4294967297"},
        {"rtu.count = 99999999999999999999\n", ":1: ", "99999999999999999999"},
        {"rtu.count = 2.0\n", ":1: ", "floating-point"},
        {"rtu.count = true\n", ":1: ", "boolean"},
        {"rtu.count = [1]\n", ":1: ", "array"},
        {"rtu.count = \"2\"\n", ":1: ", "got '2'"},
        {"[[rtu]]\ncount = 1\n", ":1: ", "got 'rtu'"},
        {"bvh.width = 3\n", ":1: ", "an even number from 2 to 8 children, got 3"},
        {"l2.line_bytes = 96\n", ":1: ", "a power of two from 32 to 1024 bytes, got 96"},
        {"\nrtu.pair.mode = \"dual\"\n", ":2: ", "single, dual_independent or dual_shared, got 'dual'"},
        {"rtu.pair.mode = 1\n", ":1: ", "got 1"},
        {"rtu.count = { source = \"a\" }\n", ":1: ", "no value"},
        {"rtu.count = { value = 1, source = 2 }\n", ":1: ", "got 'source' of type integer"},
        {"rtu.count = { value = 1, note = \"a\" }\n", ":1: ", "got 'note'"},
        {"clock_mhz 3\n", ":1: ", "expected TOML"},
        {"a = \xff\xfe\n", ":1: ", "expected TOML"},
    };
    for (const BadText& bad : cases) {
        EXPECT_THAT(error_of_text(bad.text), AllOf(HasSubstr(std::string(".toml") + std::string(bad.where)),
                                                   HasSubstr(std::string(bad.what))))
            << bad.text;
    }
}

TEST(ConfigFile, ReportsTheFirstOfSeveralMistakes) {
    EXPECT_THAT(error_of_text("rtu.count = 0\nbvh.width = 0\n"), HasSubstr(".toml:1: "));
    EXPECT_THAT(error_of_text("bvh.width = 0\nrtu.count = 0\n"), HasSubstr(".toml:1: "));
}

TEST(ConfigFile, KeepsEveryErrorOnOneLine) {
    EXPECT_THAT(error_of_text("\"a\\nb\" = 1\n"), testing::Not(HasSubstr("\n")));
    EXPECT_THAT(error_of_text("rtu.pair.mode = \"a\\nb\"\n"), testing::Not(HasSubstr("\n")));
    EXPECT_THAT(error_of_set("a\nb=1"), testing::Not(HasSubstr("\n")));
}

TEST(ConfigFile, RefusesWhatWouldExhaustTheParser) {
    std::string deep;
    for (int i = 0; i < 30'000; ++i) deep += "a.";
    EXPECT_THAT(error_of_text("\n" + deep + "a = 1\n"), HasSubstr(".toml:2: expected lines of at most"));
    EXPECT_THAT(error_of_text(std::string(2 << 20, '\n')), HasSubstr("at most 1048576 bytes"));
    EXPECT_THAT(error_of_text("a = " + std::string(1000, '[')), HasSubstr(".toml:1: expected TOML"));
}

TEST(ConfigFile, MustBeAReadableFile) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path();
    EXPECT_THAT(error_of([&] { (void)load_config("default", folder, {}); }), HasSubstr("got a directory"));
    EXPECT_THAT(error_of([&] { (void)load_config("default", folder / "no such file", {}); }),
                AllOf(HasSubstr("no such file"), HasSubstr("expected a configuration file")));
}

TEST(ConfigOptions, NameTheOptionOfEveryMistake) {
    EXPECT_THAT(error_of_set("rtu.count"), HasSubstr("--set rtu.count: expected key=value"));
    EXPECT_THAT(error_of_set("=3"), HasSubstr("--set =3: "));
    EXPECT_THAT(error_of_set("rtu.conut=3"),
                AllOf(HasSubstr("--set rtu.conut=3: "), HasSubstr("'rtu.count'?")));
    for (const char* value : {"", "0", "65", "-1", "1.5", "two", "1 2", "0x10", "99999999999999999999"}) {
        const std::string set = std::string("rtu.count=") + value;
        EXPECT_THAT(error_of_set(set), AllOf(HasSubstr("--set " + set), HasSubstr("from 1 to 64"))) << value;
    }
    const std::vector<std::string> twice{"rtu.count=2", "rtu.count=2"};
    EXPECT_THAT(error_of([&] { (void)load_config("default", {}, twice); }), HasSubstr("'rtu.count' again"));
}

TEST(Validation, NamesTheKeysOfARuleThatIsBroken) {
    EXPECT_THAT(error_of_set("l1.sector_bytes=256"),
                AllOf(HasSubstr("--set l1.sector_bytes=256: "), HasSubstr("l1.line_bytes = 128")));
    EXPECT_THAT(error_of_text("l2.line_bytes = 1024\nl2.sector_bytes = 16\n"),
                HasSubstr("at most 32 sectors"));
    EXPECT_THAT(error_of_set("l1.ways=5"), AllOf(HasSubstr("power of two sets"), HasSubstr("l1.ways = 5")));
    EXPECT_THAT(error_of_set("l1.size_bytes=1024"), HasSubstr("power of two sets"));
    EXPECT_THAT(error_of_set("l1.banks=64"), AllOf(HasSubstr("set a bank"), HasSubstr("l1.banks = 64")));
    EXPECT_THAT(error_of_set("l2.mshrs=4096"), "");
    EXPECT_THAT(error_of_set("l1.mshrs=513"), HasSubstr("l1.mshrs = 513"));
    EXPECT_THAT(error_of_set("l2.line_bytes=64"), HasSubstr("l1.line_bytes = 128, l2.line_bytes = 64"));
    EXPECT_THAT(error_of_text("\ndram.row_bytes = 256\nl2.line_bytes = 512\n"),
                AllOf(HasSubstr(".toml:"), HasSubstr("dram.row_bytes = 256")));
}

TEST(Validation, AsksNothingOfAnL2ThatAFlatMemoryReplaces) {
    const std::vector<std::string> wide_line{"l1.line_bytes=256"};
    EXPECT_THAT(error_of([&] { (void)load_config("default", {}, wide_line); }), HasSubstr("l2.line_bytes"));
    const std::vector<std::string> flat{"l1.line_bytes=256", "memory.model=flat"};
    EXPECT_EQ(error_of([&] { (void)load_config("default", {}, flat); }), "");
}

TEST(Validation, CatchesRangesThatCodeBreaks) {
    EffectiveConfig config = default_config();
    config.config.rtu.ray_slots = 0;
    EXPECT_THAT(error_of([&] { validate(config); }), HasSubstr("rtu.ray_slots: expected a number from 1"));
}

}  // namespace
}  // namespace rtu::sim
