#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ostream>

#include "model/gltf.hpp"
#include "model/pairing.hpp"
#include "tests/model/reference_pairing.hpp"
#include "tests/scenes.hpp"

namespace rtu::test {
namespace {

using namespace rtu::model;

/// Paired percent of a real scene, measured with an independent program.
struct SceneRow {
    const char* name;
    const char *window_index, *window_position, *bbsa_index, *bbsa_position;
};

void PrintTo(const SceneRow& row, std::ostream* out) { *out << row.name; }

class PairingOfScene : public testing::TestWithParam<SceneRow> {
  protected:
    void SetUp() override {
        const auto file = scene_file(fmt::format("{}.glb", GetParam().name));
        if (!file) GTEST_SKIP() << "no scene " << GetParam().name;
        mesh_ = load_gltf(*file);
    }
    [[nodiscard]] Pairing pair(const char* method, EdgeIdentity identity) const {
        return pair_triangles(mesh_, parse_pairing_method(method), identity);
    }
    [[nodiscard]] std::string percent(const char* method, EdgeIdentity identity) const {
        return fmt::format("{:.2f}", pair(method, identity).paired_percent());
    }
    TriangleMesh mesh_;
};

TEST_P(PairingOfScene, ReproducesThePublishedShareToTheDigit) {
    EXPECT_EQ(percent("window:2", EdgeIdentity::Index), GetParam().window_index);
    EXPECT_EQ(percent("window:2", EdgeIdentity::Position), GetParam().window_position);
    EXPECT_EQ(percent("edge_bbsa", EdgeIdentity::Index), GetParam().bbsa_index);
    EXPECT_EQ(percent("edge_bbsa", EdgeIdentity::Position), GetParam().bbsa_position);
}

TEST_P(PairingOfScene, EqualsTheReference) {
    const std::size_t count = mesh_.triangles.size();
    for (const EdgeIdentity identity : {EdgeIdentity::Index, EdgeIdentity::Position}) {
        EXPECT_TRUE(partners_of(pair("edge_bbsa", identity), count) == reference_edge_bbsa(mesh_, identity));
        EXPECT_TRUE(partners_of(pair("window:8", identity), count) == reference_window(mesh_, 8, identity));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PairingOfScene,
                         testing::Values(SceneRow{"bunny", "65.69", "65.69", "97.30", "97.30"},
                                         SceneRow{"dragon", "56.45", "56.52", "89.63", "89.67"},
                                         SceneRow{"conference", "98.69", "96.43", "93.13", "93.35"},
                                         SceneRow{"sponza", "97.86", "97.86", "96.40", "96.40"},
                                         SceneRow{"bmw_m6", "98.33", "98.38", "96.18", "96.20"},
                                         SceneRow{"kitchen", "99.83", "99.92", "95.37", "95.30"},
                                         SceneRow{"coffee_maker", "4.07", "4.98", "96.23", "97.49"},
                                         SceneRow{"legocar", "99.00", "99.00", "97.11", "97.13"},
                                         SceneRow{"hospital_firealarms", "32.43", "46.52", "32.47", "92.11"},
                                         SceneRow{"sanmiguel_arch", "85.76", "85.76", "96.36", "96.36"}),
                         [](const testing::TestParamInfo<SceneRow>& row) {
                             return std::string(row.param.name);
                         });

}  // namespace
}  // namespace rtu::test
