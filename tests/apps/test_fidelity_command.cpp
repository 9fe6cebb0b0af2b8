#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

class FidelityCommand : public CommandLine {
  protected:
    [[nodiscard]] ProcessResult compare(std::vector<std::string> more) const {
        more.insert(more.begin(), {"fidelity", "ball.glb", "--resolution", "32x32", "--preset", "default"});
        return run(more);
    }
    void expect_error(const ProcessResult& result, const std::string& text) const {
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.err, AllOf(HasSubstr(text), EndsWith("\n")));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_THAT(result.out, IsEmpty());
    }
};

TEST_F(FidelityCommand, HelpTeaches) {
    EXPECT_THAT(run({"fidelity", "--help"}).out, AllOf(HasSubstr("Examples:"), HasSubstr("--tolerance")));
    EXPECT_THAT(run({"run", "--help"}).out, AllOf(HasSubstr("--fidelity"), HasSubstr("queueing model")));
}

TEST_F(FidelityCommand, RowsSayWhatTheyShould) {
    const ProcessResult result = compare({"--no-ranking", "--workload", "primary", "--json", "-"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    ASSERT_EQ(json["rows"].size(), 5U);
    for (const auto& row : json["rows"]) {
        EXPECT_EQ(row["scene"], "ball");
        EXPECT_EQ(row["workload"], "primary");
        EXPECT_EQ(row["total_rays"], 1024);
        EXPECT_GT(row["mrps"], 0);
        EXPECT_LE(row["mrps_low"], row["mrps"]);
        EXPECT_LE(row["mrps"], row["mrps_high"]);
    }
    EXPECT_EQ(json["rows"][0]["level"], "cycle");
    EXPECT_EQ(json["rows"][0]["error_percent"], 0);
    EXPECT_EQ(json["rows"][3]["level"], "sampled");
    EXPECT_EQ(json["rows"][3]["error_percent"], 0) << "so few rays are all simulated";
}

TEST_F(FidelityCommand, RanksTwentyMachines) {
    const ProcessResult result = compare({"--workload", "primary", "--level", "analytic,sampled"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, AllOf(HasSubstr("Order of 20 machines"), HasSubstr("Kendall")));
}

TEST_F(FidelityCommand, RunEstimatesTheSameTwice) {
    const auto estimate = [&] {
        const ProcessResult result = run_ball({"--fidelity", "analytic", "--json", "-"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        auto json = nlohmann::json::parse(result.out);
        for (auto& row : json["rows"]) row.erase("host_rays_per_second");
        return json;
    };
    EXPECT_EQ(estimate(), estimate());
    EXPECT_EQ(estimate()["rows"].size(), 3U);
}

TEST_F(FidelityCommand, AutoSaysWhatItModelled) {
    const auto modelled = [&](const char* tolerance) {
        const ProcessResult result = run_ball({"--fidelity", "auto", "--tolerance", tolerance});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result.out;
    };
    EXPECT_THAT(modelled("10"), AllOf(HasSubstr("What was modelled"), HasSubstr("queueing model")));
    EXPECT_THAT(modelled("2"), HasSubstr("every ray; too few rays to gain by samples"));
}

TEST_F(FidelityCommand, BadValuesAreErrors) {
    expect_error(run_ball({"--fidelity", "best"}),
                 "--fidelity: expected counts, analytic, sampled, cycle, rtl or auto, got 'best'");
    EXPECT_EQ(run_ball({"--fidelity", "rtl"}).exit_code, 1) << "the default machine is not that of the RTL";
    for (const char* bad : {"0.5", "51", "2%", "nan", "-2"}) {
        expect_error(run_ball({"--fidelity", "auto", "--tolerance=" + std::string(bad)}),
                     "--tolerance: expected a number of percent from 0.6 to 50");
    }
    expect_error(run_ball({"--tolerance", "2"}), "--tolerance: needs --fidelity sampled or auto");
    expect_error(run_ball({"--fidelity", "sampled", "--check"}), "--check: needs --fidelity cycle");
    expect_error(run_ball({"--fidelity", "counts", "--image", "out"}), "--image: needs --fidelity cycle");
    expect_error(compare({"--level", "cycle"}), "--level: cycle is what the others are compared with");
    expect_error(compare({"--level", "sampled,sampled"}), "--level: 'sampled' is given twice");
    expect_error(run({"fidelity", "--preset", "best"}), "best");
}

}  // namespace
}  // namespace rtu::test
