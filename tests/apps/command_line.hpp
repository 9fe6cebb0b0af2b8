#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/process.hpp"
#include "tests/model/gltf_builder.hpp"
#include "tests/model/meshes.hpp"

namespace rtu::test {

/// Runs the built program in a folder of its own that holds a small scene, ball.glb.
class CommandLine : public testing::Test {
  protected:
    CommandLine() {
        const TriangleMesh mesh = closed_sphere(12, {0, 0, 0}, 1);
        std::vector<std::uint32_t> indices;
        for (const model::Triangle& triangle : mesh.triangles) {
            indices.insert(indices.end(), triangle.begin(), triangle.end());
        }
        GltfBuilder builder;
        const std::size_t positions = builder.add_positions(mesh.positions);
        const std::size_t accessor = builder.add_indices(indices);
        builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", accessor}});
        static_cast<void>(folder_.write("ball.glb", builder.glb()));
    }

    Process start(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), program_path());
        return Process(folder_.path(), arguments);
    }
    ProcessResult run(const std::vector<std::string>& arguments) const { return start(arguments).wait(); }
    /// A quick run of the small scene, with more options.
    ProcessResult run_ball(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"run", "ball.glb", "--resolution", "16x16"});
        return run(more);
    }
    /// Bad input (1) or wrong usage (2): that exit code, one line on standard error that holds `text`,
    /// nothing on standard output, and the same files as before.
    void expect_refusal(const std::vector<std::string>& arguments, const std::string& text,
                        int exit_code = 1) const {
        const std::vector<std::string> before = names();
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, exit_code) << result.err;
        EXPECT_THAT(result.err, testing::AllOf(testing::StartsWith("rtusim: "), testing::HasSubstr(text)));
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        EXPECT_THAT(result.out, testing::IsEmpty());
        EXPECT_THAT(names(), testing::UnorderedElementsAreArray(before));
    }
    std::vector<std::string> names() const {
        std::vector<std::string> result;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
            result.push_back(entry.path().filename());
        }
        return result;
    }
    std::string content(const std::string& name) const { return read_file(folder_.path() / name); }

    TemporaryFolder folder_;
};

/// A report of one scene without what differs from run to run.
inline nlohmann::json without_host_times(const std::string& text) {
    nlohmann::json json = nlohmann::json::parse(text);
    json.erase("host");
    json["pairing"].erase("seconds");
    json["bvh"].erase("build_seconds");
    return json;
}

}  // namespace rtu::test
