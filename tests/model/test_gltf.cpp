#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <ostream>
#include <vector>

#include "model/gltf.hpp"
#include "tests/model/gltf_builder.hpp"
#include "tests/scenes.hpp"

namespace rtu::model {
namespace {

using test::GltfBuilder;
using test::TemporaryFolder;
using Triangles = std::vector<Triangle>;

const Triangles square_triangles{{0, 1, 2}, {0, 2, 3}};
const std::vector<Vec3> square_positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TriangleMesh load(const GltfBuilder& builder) {
    const TemporaryFolder folder;
    return load_gltf(folder.write("scene.glb", builder.glb()));
}

/// A primitive of five corners around a point, not indexed.
GltfBuilder five_corners(int mode) {
    GltfBuilder builder;
    const std::size_t positions =
        builder.add_positions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 2, 0}, {-1, 1, 0}});
    builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
    return builder;
}

TEST(Gltf, LoadsAGlb) {
    const TemporaryFolder folder;
    const TriangleMesh mesh = load_gltf(folder.write("a square.glb", test::square().glb()));
    EXPECT_EQ(mesh.name, "a square");
    EXPECT_EQ(mesh.positions, square_positions);
    EXPECT_EQ(mesh.triangles, square_triangles);
}

TEST(Gltf, LoadsJsonWithADataUri) {
    const TemporaryFolder folder;
    const TriangleMesh mesh = load_gltf(folder.write("scene.gltf", test::square().gltf()));
    EXPECT_EQ(mesh.positions, square_positions);
    EXPECT_EQ(mesh.triangles, square_triangles);
}

TEST(Gltf, TellsTheFormatsApartByContentAndNotByName) {
    const TemporaryFolder folder;
    EXPECT_EQ(load_gltf(folder.write("scene.gltf", test::square().glb())).triangles, square_triangles);
    EXPECT_EQ(load_gltf(folder.write("scene.glb", "\n " + test::square().gltf())).triangles,
              square_triangles);
}

TEST(Gltf, LoadsAnExternalBufferWithAPercentEncodedName) {
    const TemporaryFolder folder;
    GltfBuilder builder = test::square();
    std::filesystem::create_directory(folder.path() / "data");
    static_cast<void>(folder.write("data/my buffer.bin", builder.bytes + "padding"));
    builder.document["buffers"] = {{{"byteLength", builder.bytes.size()}, {"uri", "data/my%20buffer.bin"}}};
    EXPECT_EQ(load_gltf(folder.write("scene.gltf", builder.gltf())).triangles, square_triangles);
}

TEST(Gltf, ReadsIndicesOfEightSixteenAndThirtyTwoBits) {
    for (const int bits : {8, 16, 32}) {
        GltfBuilder builder;
        const std::size_t positions = builder.add_positions(square_positions);
        const std::size_t indices =
            bits == 8    ? builder.add_indices(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3})
            : bits == 16 ? builder.add_indices(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3})
                         : builder.add_indices(std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
        builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
        EXPECT_EQ(load(builder).triangles, square_triangles) << bits << " bits";
    }
}

TEST(Gltf, ReadsStripsWithAlternatingWinding) {
    EXPECT_EQ(load(five_corners(5)).triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
}

TEST(Gltf, ReadsFansAroundTheFirstCorner) {
    EXPECT_EQ(load(five_corners(6)).triangles, (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(Gltf, ReadsIndexedStrips) {
    GltfBuilder builder;
    const std::size_t positions = builder.add_positions(square_positions);
    const std::size_t indices = builder.add_indices(std::vector<std::uint8_t>{3, 0, 2, 1});
    builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"mode", 5}});
    EXPECT_EQ(load(builder).triangles, (Triangles{{3, 0, 2}, {0, 1, 2}}));
}

TEST(Gltf, ReadsTrianglesWithoutIndices) {
    GltfBuilder builder;
    const std::size_t positions =
        builder.add_positions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}});
    builder.add_mesh({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(load(builder).triangles, (Triangles{{0, 1, 2}, {3, 4, 5}}));
}

TEST(Gltf, SkipsPointsAndLinesAndPrimitivesWithoutPositions) {
    GltfBuilder builder = test::square();
    for (const int mode : {0, 1, 2, 3}) {
        builder.document["meshes"][0]["primitives"].push_back(
            {{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
    }
    builder.document["meshes"][0]["primitives"].push_back({{"attributes", {{"NORMAL", 0}}}});
    const TriangleMesh mesh = load(builder);
    EXPECT_EQ(mesh.triangles, square_triangles);
    EXPECT_EQ(mesh.positions.size(), 4U);
}

TEST(Gltf, ReadsInterleavedBufferViews) {
    GltfBuilder builder;
    std::vector<float> interleaved;  // position, then a normal that must not be read
    for (const Vec3 p : square_positions) {
        interleaved.insert(interleaved.end(), {p.x, p.y, p.z, NAN, NAN, NAN});
    }
    interleaved.resize(interleaved.size() - 3);  // the last element need not fill its stride
    const std::size_t view = builder.add_view(std::span<const float>(interleaved), 24);
    const std::size_t positions = builder.add_accessor(
        {{"bufferView", view}, {"componentType", test::component_float}, {"count", 4}, {"type", "VEC3"}});
    builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 6}});
    EXPECT_EQ(load(builder).positions, square_positions);
}

TEST(Gltf, AddsTheOffsetsOfViewAndAccessor) {
    GltfBuilder builder;
    static_cast<void>(builder.add_view(std::span<const float>(std::vector<float>{7, 7})));
    const std::vector<Vec3> data{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    const std::size_t view = builder.add_view(std::span(data));
    const std::size_t positions = builder.add_accessor({{"bufferView", view},
                                                        {"byteOffset", 12},
                                                        {"componentType", test::component_float},
                                                        {"count", 3},
                                                        {"type", "VEC3"}});
    builder.add_mesh({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(load(builder).positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
}

TEST(Gltf, AppliesSparseElementsToABaseAndToZeros) {
    for (const bool has_base : {true, false}) {
        GltfBuilder builder;
        const std::size_t base = builder.add_view(std::span(square_positions));
        const std::vector<std::uint8_t> targets{1, 2};
        const std::vector<Vec3> values{{5, 0, 0}, {5, 5, 5}};
        nlohmann::json accessor = {
            {"componentType", test::component_float},
            {"count", 4},
            {"type", "VEC3"},
            {"sparse",
             {{"count", 2},
              {"indices", {{"bufferView", builder.add_view(std::span(targets))}, {"componentType", 5121}}},
              {"values", {{"bufferView", builder.add_view(std::span(values))}}}}}};
        if (has_base) {
            accessor["bufferView"] = base;
        }
        const std::size_t positions = builder.add_accessor(accessor);
        builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 6}});
        EXPECT_EQ(
            load(builder).positions,
            (std::vector<Vec3>{{0, 0, 0}, {5, 0, 0}, {5, 5, 5}, has_base ? Vec3{0, 1, 0} : Vec3{0, 0, 0}}));
    }
}

TEST(Gltf, AnAccessorWithoutAViewIsAllZeros) {
    GltfBuilder builder = test::square();
    const std::size_t zeros =
        builder.add_accessor({{"componentType", test::component_float}, {"count", 3}, {"type", "VEC3"}});
    builder.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", zeros}}}});
    const TriangleMesh mesh = load(builder);
    EXPECT_EQ(mesh.triangles.back(), (Triangle{4, 5, 6}));
    EXPECT_EQ(mesh.positions.back(), Vec3{});
    EXPECT_EQ(count_degenerate(mesh), 1U);
}

TEST(Gltf, KeepsUnusedVerticesAndDegenerateTriangles) {
    GltfBuilder builder;
    const std::size_t positions = builder.add_positions({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const std::size_t indices = builder.add_indices(std::vector<std::uint32_t>{1, 1, 2, 1, 2, 3});
    builder.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    const TriangleMesh mesh = load(builder);
    EXPECT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.triangles, (Triangles{{1, 1, 2}, {1, 2, 3}}));
    EXPECT_EQ(bounds(mesh), (Aabb{{0, 0, 0}, {1, 1, 0}}));
}

TEST(Gltf, AnIdentityHierarchyLeavesEveryBitOfThePositions) {
    GltfBuilder builder;
    const std::vector<Vec3> awkward{
        {-0.0F, 1e-45F, 9.9e10F}, {0.1F, -0.0F, 1.0F / 3.0F}, {-1e-20F, 7.0F, -0.0F}};
    const std::size_t positions = builder.add_positions(awkward);
    builder.add_mesh({{"attributes", {{"POSITION", positions}}}});
    builder.document["nodes"] = {
        {{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}},
        {{"mesh", 0}, {"rotation", {0, 0, 0, 1}}, {"scale", {1, 1, 1}}, {"translation", {0, 0, 0}}}};
    const TriangleMesh mesh = load(builder);
    ASSERT_EQ(mesh.positions.size(), 3U);
    for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(mesh.positions[i / 3][i % 3]),
                  std::bit_cast<std::uint32_t>(awkward[i / 3][i % 3]));
    }
}

TEST(Gltf, AppliesScaleThenRotationThenTranslation) {
    GltfBuilder builder = test::square();
    const double half = std::sqrt(0.5);
    builder.document["nodes"][0] = {
        {"mesh", 0}, {"scale", {2, 3, 1}}, {"rotation", {0, 0, half, half}}, {"translation", {10, 20, 30}}};
    // A quarter turn around z: (x, y) -> (-y, x).
    EXPECT_EQ(load(builder).positions,
              (std::vector<Vec3>{{10, 20, 30}, {10, 22, 30}, {7, 22, 30}, {7, 20, 30}}));
}

TEST(Gltf, AMatrixIsColumnMajorAndParentsApplyLast) {
    GltfBuilder builder = test::square();
    builder.document["nodes"] = {
        {{"children", {1}}, {"translation", {100, 0, 0}}},
        {{"children", {2}}, {"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 5, 1}}},
        {{"mesh", 0}, {"translation", {1, 0, 0}}}};
    EXPECT_EQ(load(builder).positions, (std::vector<Vec3>{{100, 2, 5}, {100, 4, 5}, {98, 4, 5}, {98, 2, 5}}));
}

TEST(Gltf, RoundsToFloatOnlyOnceAfterTheWholeHierarchy) {
    GltfBuilder builder;
    const std::size_t positions = builder.add_positions({{0.1F, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    builder.add_mesh({{"attributes", {{"POSITION", positions}}}});
    // In float the first translation would swallow the position.
    builder.document["nodes"] = {{{"children", {1}}, {"translation", {-1e9, 0, 0}}},
                                 {{"mesh", 0}, {"translation", {1e9, 0, 0}}}};
    EXPECT_EQ(load(builder).positions[0].x, 0.1F);
}

TEST(Gltf, MirrorsKeepTheWindingOutwards) {
    GltfBuilder builder = test::square();
    builder.document["nodes"][0]["scale"] = {-1, 1, 1};
    const TriangleMesh mesh = load(builder);
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 2, 1}, {0, 3, 2}}));
    const auto& [a, b, c] = mesh.triangles[0];
    EXPECT_GT(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z, 0.0F);
}

TEST(Gltf, FlattensInstancesInDepthFirstOrder) {
    GltfBuilder builder = test::square();
    builder.document["scenes"][0]["nodes"] = {3, 0};
    builder.document["nodes"] = {{{"mesh", 0}, {"translation", {1, 0, 0}}},
                                 {{"mesh", 0}, {"translation", {2, 0, 0}}},
                                 {{"mesh", 0}, {"translation", {3, 0, 0}}},
                                 {{"children", {2, 1}}}};
    const TriangleMesh mesh = load(builder);
    ASSERT_EQ(mesh.positions.size(), 12U);
    EXPECT_EQ(mesh.positions[0].x, 3.0F);
    EXPECT_EQ(mesh.positions[4].x, 2.0F);
    EXPECT_EQ(mesh.positions[8].x, 1.0F);
    EXPECT_EQ(mesh.triangles,
              (Triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {8, 9, 10}, {8, 10, 11}}));
}

TEST(Gltf, TakesTheDefaultSceneElseTheFirstElseAllRoots) {
    GltfBuilder builder = test::square();
    builder.document["nodes"] = {{{"mesh", 0}, {"translation", {1, 0, 0}}},
                                 {{"children", {0}}, {"translation", {10, 0, 0}}},
                                 {{"mesh", 0}, {"translation", {5, 0, 0}}}};
    builder.document["scenes"] = {{{"nodes", {2}}}, {{"nodes", {0}}}};
    builder.document["scene"] = 1;
    EXPECT_EQ(load(builder).positions[0].x, 1.0F);
    builder.document.erase("scene");
    EXPECT_EQ(load(builder).positions[0].x, 5.0F);
    builder.document.erase("scenes");
    const TriangleMesh mesh = load(builder);
    ASSERT_EQ(mesh.positions.size(), 8U);
    EXPECT_EQ(mesh.positions[0].x, 11.0F);
    EXPECT_EQ(mesh.positions[4].x, 5.0F);
}

TEST(Gltf, ReadsADeepHierarchyWithoutRecursion) {
    constexpr std::size_t depth = 100'000;
    GltfBuilder builder = test::square();
    nlohmann::json nodes = nlohmann::json::array();
    for (std::size_t i = 0; i + 1 < depth; ++i) {
        nodes.push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
    }
    nodes.push_back({{"mesh", 0}});
    builder.document["nodes"] = nodes;
    EXPECT_EQ(load(builder).positions[0].x, float(depth - 1));
}

TEST(Gltf, IgnoresImagesTexturesAndMaterialsEvenBrokenOnes) {
    GltfBuilder builder = test::square();
    builder.document["images"] = {
        {{"uri", "missing.png"}}, {{"bufferView", 99}, {"mimeType", "image/png"}}, 7};
    builder.document["textures"] = {{{"source", 12}}};
    builder.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 5}}}}}}};
    builder.document["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_transform"};
    builder.primitive()["material"] = 3;
    EXPECT_EQ(load(builder).triangles, square_triangles);
}

struct RealScene {
    const char* file;
    std::size_t triangle_count;
    std::size_t vertex_count;
};

void PrintTo(const RealScene& scene, std::ostream* out) { *out << scene.file; }

class GltfRealScene : public testing::TestWithParam<RealScene> {};

TEST_P(GltfRealScene, HasThePublishedCounts) {
    const std::optional<std::filesystem::path> file = test::scene_file(GetParam().file);
    if (!file) {
        GTEST_SKIP() << GetParam().file << " is not there: set RTUSIM_SCENES to the folder of real scenes";
    }
    const TriangleMesh mesh = load_gltf(*file);
    EXPECT_EQ(mesh.triangles.size(), GetParam().triangle_count);
    EXPECT_EQ(mesh.positions.size(), GetParam().vertex_count);
}

INSTANTIATE_TEST_SUITE_P(Scenes, GltfRealScene,
                         testing::Values(RealScene{"bunny.glb", 69'630, 34'817},
                                         RealScene{"dragon.glb", 871'414, 437'645},
                                         RealScene{"conference.glb", 331'179, 194'399},
                                         RealScene{"sponza.glb", 279'163, 153'635},
                                         RealScene{"legocar.glb", 10'992, 5'968},
                                         RealScene{"hospital_firealarms.glb", 398'698, 972'687}),
                         [](const auto& parameter) {
                             const std::string name = parameter.param.file;
                             return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace rtu::model
