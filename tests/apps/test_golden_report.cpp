#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using Json = nlohmann::json;
using GoldenReport = CommandLine;

// The whole program on the built-in scene, every workload: each count and cycle is pinned. After a wanted
// change: RTUSIM_WRITE_GOLDEN=1 build/dev/tests/test_apps --gtest_filter='GoldenReport.*', then read the
// diff.
TEST_F(GoldenReport, OfTheBuiltInSceneIsUnchanged) {
    const std::string path = std::string(RTUSIM_SOURCE_DIR) + "/tests/apps/golden/builtin.json";
    const ProcessResult result = run({"run", "--resolution", "64x64", "--workload",
                                      "primary,shadow,ao,diffuse,random", "--check", "--json", "-"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    Json report = without_host_times(result.out);
    report.erase("version");
    if (std::getenv("RTUSIM_WRITE_GOLDEN") != nullptr) std::ofstream(path) << report.dump(1) << "\n";
    const Json golden = Json::parse(read_file(path), nullptr, false);
    ASSERT_TRUE(golden.is_object()) << path;
    // A list of what differs says more than two long texts.
    EXPECT_EQ(Json::diff(golden, report), Json::array());
}

}  // namespace
}  // namespace rtu::test
