#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using Json = nlohmann::json;

// With a second scene that spatial splits find something in.
class MailboxCommand : public CommandLine {
  protected:
    MailboxCommand() {
        const TriangleMesh mesh = needles(1'500, 1, {0, 0, 0});
        std::vector<std::uint32_t> indices;
        for (const model::Triangle& triangle : mesh.triangles) {
            indices.insert(indices.end(), triangle.begin(), triangle.end());
        }
        GltfBuilder builder;
        const std::size_t positions = builder.add_positions(mesh.positions);
        const std::size_t accessor = builder.add_indices(indices);
        builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", accessor}});
        static_cast<void>(folder_.write("needles.glb", builder.glb()));
    }
    static std::vector<std::string> small(std::vector<std::string> more = {}) {
        std::vector<std::string> all{"mailbox",    "needles.glb", "--resolution", "24x24",
                                     "--pairings", "window:2",    "--entries",    "1,16"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

TEST_F(MailboxCommand, HelpTeaches) {
    const ProcessResult result = run({"mailbox", "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out,
                AllOf(HasSubstr("Examples:"), HasSubstr("--entries"), HasSubstr("spatial splits")));
}

TEST_F(MailboxCommand, HasARowForEachTreeWorkloadAndMailbox) {
    const ProcessResult one = run(small({"--threads", "1", "--json", "-", "--csv", "one.csv"}));
    const ProcessResult many = run(small({"--json", "-", "--csv", "many.csv"}));
    ASSERT_EQ(one.exit_code, 0) << one.err;
    EXPECT_EQ(one.out, many.out);
    EXPECT_EQ(content("one.csv"), content("many.csv"));
    const Json rows = Json::parse(one.out)["rows"];
    ASSERT_EQ(rows.size(), 3U * (1 + 5));  // object: none; spatial: none, two recent, hashed, per_pair
    for (const Json& row : rows) {
        const bool is_split = row["splits"] == "spatial";
        EXPECT_EQ(row["extra_leaf_percent"].get<double>() > 0, is_split);
        if (!is_split || row["mailbox"] == "per_pair") {
            EXPECT_EQ(row["duplicate_tests"], 0);
            EXPECT_EQ(row["reported_twice"], 0);
        }
        if (row["mailbox"] == "none") {
            EXPECT_EQ(row["mailbox_hits"], 0);
        }
    }
    // What a mailbox finds is what is not tested again.
    const auto row = [&](std::string_view mailbox, int entries) {
        for (const Json& each : rows) {
            if (each["workload"] == "primary" && each["splits"] == "spatial" && each["mailbox"] == mailbox &&
                each["entries"] == entries) {
                return each;
            }
        }
        ADD_FAILURE() << mailbox;
        return Json();
    };
    const Json none = row("none", 0), per_pair = row("per_pair", 0), many_entries = row("recent", 16);
    EXPECT_GT(none["duplicate_tests"], 0);
    EXPECT_EQ(per_pair["mailbox_hits"], none["duplicate_tests"]);
    EXPECT_EQ(per_pair["pair_tests"].get<int>() + per_pair["mailbox_hits"].get<int>(), none["pair_tests"]);
    EXPECT_GE(many_entries["mailbox_hits"], row("recent", 1)["mailbox_hits"]);
    EXPECT_GT(many_entries["gates"], none["gates"]);
}

// The sums over trees are those of the rows, and the gates what `rtusim area` says.
TEST_F(MailboxCommand, SumsUpWhatEachMailboxFindsAndTakes) {
    const ProcessResult result = run(small({"--workload", "primary,shadow", "--json", "-"}));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json report = Json::parse(result.out);
    const auto area = [&](const std::vector<std::string>& sets) {
        std::vector<std::string> command{"area", "--json", "-"};
        for (const std::string& set : sets) command.insert(command.end(), {"--set", set});
        return Json::parse(run(command).out)["machine"]["rtu"];
    };
    const Json plain = area({});
    ASSERT_EQ(report["mailboxes"].size(), 4U);
    for (const Json& mailbox : report["mailboxes"]) {
        std::uint64_t found = 0, duplicates = 0;
        for (const Json& row : report["rows"]) {
            if (row["splits"] != "spatial") continue;
            if (row["mailbox"] == "none") duplicates += row["duplicate_tests"].get<std::uint64_t>();
            if (row["mailbox"] == mailbox["mailbox"] && row["entries"] == mailbox["entries"]) {
                found += row["mailbox_hits"].get<std::uint64_t>();
            }
        }
        EXPECT_GT(found, 0U);
        EXPECT_EQ(mailbox["found"], found);
        EXPECT_EQ(mailbox["duplicates"], duplicates);
        const Json with = area({"rtu.mailbox.kind=" + mailbox["mailbox"].get<std::string>(),
                                "rtu.mailbox.entries=" + std::to_string(mailbox["entries"].get<int>())});
        EXPECT_NEAR(mailbox["gates_added"].get<double>(),
                    with["gates"].get<double>() - plain["gates"].get<double>(), 0.1);
        EXPECT_NEAR(mailbox["sram_bits_added"].get<double>(),
                    with["sram_bits"].get<double>() - plain["sram_bits"].get<double>(), 0.1);
        EXPECT_LE(mailbox["least_mrps_percent"], mailbox["most_mrps_percent"]);
    }
}

TEST_F(MailboxCommand, TellsWhatPairingAndSplitsAreWorthToEachKindOfRays) {
    const ProcessResult result =
        run({"mailbox", "needles.glb", "--resolution", "24x24", "--pairings", "none,window:2", "--entries",
             "1", "--workload", "primary,shadow", "--json", "-"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json report = Json::parse(result.out);
    const auto cycles = [&](const char* workload, const char* pairing, const char* splits) {
        for (const Json& row : report["rows"]) {
            if (row["workload"] == workload && row["pairing"] == pairing && row["splits"] == splits &&
                row["mailbox"] == "none") {
                return row["cycles"].get<double>();
            }
        }
        return 0.0;
    };
    ASSERT_EQ(report["worth"].size(), 3U);
    const auto gain = [](double before, double after) { return 100 * (before / after - 1); };
    const Json shadow = report["worth"][1];
    EXPECT_EQ(shadow["workload"], "shadow");
    const double neither = cycles("shadow", "none", "object"), split = cycles("shadow", "none", "spatial");
    const double paired = cycles("shadow", "window:2", "object");
    const double both = cycles("shadow", "window:2", "spatial");
    EXPECT_NEAR(shadow["pairing_alone_percent"].get<double>(), gain(neither, paired), 1e-9);
    EXPECT_NEAR(shadow["splits_alone_percent"].get<double>(), gain(neither, split), 1e-9);
    EXPECT_NEAR(shadow["pairing_with_splits_percent"].get<double>(), gain(split, both), 1e-9);
    EXPECT_NEAR(shadow["splits_with_pairing_percent"].get<double>(), gain(paired, both), 1e-9);
    EXPECT_NEAR(shadow["both_percent"].get<double>(), gain(neither, both), 1e-9);
    EXPECT_EQ(report["worth"][2]["workload"], "all");
}

TEST_F(MailboxCommand, WritesPictures) {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot here";
    const ProcessResult result = run(small({"--workload", "primary", "--charts", "pictures"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(content("pictures/mailbox_needles_mrps.png"), StartsWith("\x89PNG"));
    EXPECT_THAT(result.out, HasSubstr("needles: against window:2 and object splits"));
}

TEST_F(MailboxCommand, RefusesWhatItVariesAndWhatCannotBe) {
    const auto refuses = [&](const std::vector<std::string>& more, const std::string& text) {
        std::vector<std::string> arguments{"mailbox", "needles.glb"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_refusal(arguments, text);
    };
    refuses({"--set", "rtu.mailbox.entries=4"}, "expected them not to be set");
    refuses({"--set", "bvh.splits=spatial"}, "expected them not to be set");
    refuses({"--set", "bvh.max_leaf_pairs=2"}, "expected 1");
    refuses({"--entries", "17"}, "expected numbers from 1 to 16, got '17'");
    refuses({"--entries", "1,x"}, "got 'x'");
    refuses({"--pairings", "best"}, "best");
    refuses({"needles.glb"}, "two scenes are called 'needles'");
}

TEST_F(MailboxCommand, ChecksARunWithSplitsAndMailbox) {
    const std::vector<std::string> machine{"--set", "bvh.splits=spatial", "--set", "rtu.mailbox.entries=4"};
    std::vector<std::string> arguments{"run", "needles.glb", "--resolution", "24x24", "--check", "--json",
                                       "-"};
    arguments.insert(arguments.end(), machine.begin(), machine.end());
    const ProcessResult checked = run(arguments);
    ASSERT_EQ(checked.exit_code, 0) << checked.err;
    const Json report = Json::parse(checked.out);
    EXPECT_EQ(report["check"]["mismatches"], 0);
    EXPECT_GT(report["bvh"]["extra_leaf_count"], 0);
    EXPECT_GT(report["workloads"][0]["units"]["scheduler"]["counters"]["mailbox_hits"], 0);
    expect_refusal({"run", "needles.glb", "--fidelity", "sampled", "--set", "rtu.mailbox.entries=4"},
                   "mailbox");
}

// A recording has no mailbox and belongs to its tree.
TEST_F(MailboxCommand, ReplaysARecordingWithAnyMailboxButNotOnAnotherTree) {
    const std::vector<std::string> split{"--set", "bvh.splits=spatial"};
    const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    const ProcessResult recorded = run(
        with({"trace", "record", "needles.glb", "a.rtutrace", "--visits", "--resolution", "24x24"}, split));
    ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
    for (const std::string entries : {"0", "2"}) {
        const std::vector<std::string> machine =
            with(split, {"--set", "rtu.mailbox.entries=" + entries, "--json", "-"});
        const ProcessResult replayed = run(with({"trace", "replay", "a.rtutrace", "needles.glb"}, machine));
        const ProcessResult whole = run(with({"run", "needles.glb", "--resolution", "24x24"}, machine));
        ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
        EXPECT_EQ(Json::parse(replayed.out)["workloads"], Json::parse(whole.out)["workloads"]);
    }
    expect_refusal({"trace", "replay", "a.rtutrace", "needles.glb"},
                   "tree 4 wide, spatial splits; this is of");
}

}  // namespace
}  // namespace rtu::test
