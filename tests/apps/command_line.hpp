#pragma once

#include <gtest/gtest.h>

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
        arguments.insert(arguments.begin(), RTUSIM_EXECUTABLE);
        return Process(folder_.path(), arguments);
    }
    ProcessResult run(const std::vector<std::string>& arguments) const { return start(arguments).wait(); }
    /// A quick run of the small scene, with more options.
    ProcessResult run_ball(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"run", "ball.glb", "--resolution", "16x16"});
        return run(more);
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
