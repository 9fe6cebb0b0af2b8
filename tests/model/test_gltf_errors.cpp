#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/error.hpp"
#include "model/gltf.hpp"
#include "tests/model/gltf_builder.hpp"

namespace rtu::model {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// What load_gltf says about a bad file; anything but rtu::Error escapes and fails the test.
std::string error_of(const std::filesystem::path& file) {
    try {
        const TriangleMesh mesh = load_gltf(file);
        return "loaded " + std::to_string(mesh.triangles.size()) + " triangles";
    } catch (const Error& error) {
        return error.what();
    }
}

/// Expects one line that starts with the file's name and contains `text`.
void expect_error(const std::filesystem::path& file, const std::string& text) {
    EXPECT_THAT(error_of(file),
                AllOf(StartsWith(file.string() + ": "), HasSubstr(text), Not(HasSubstr("\n"))));
}

void expect_error(const GltfBuilder& builder, const std::string& text) {
    const TemporaryFolder folder;
    expect_error(folder.write("scene.glb", builder.glb()), text);
}

void expect_error(const std::function<void(GltfBuilder&)>& damage, const std::string& text) {
    GltfBuilder builder = test::square();
    damage(builder);
    expect_error(builder, text);
}

TEST(GltfErrors, FilesThatCannotBeRead) {
    const TemporaryFolder folder;
    expect_error(folder.path() / "missing.glb", "no such file");
    expect_error(folder.path(), "expected a file, found a directory");
    expect_error(folder.write("empty.glb", ""), "the file is empty");
    const std::filesystem::path pipe = folder.path() / "pipe.glb";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    expect_error(pipe, "expected a regular file");
    const std::filesystem::path locked = folder.write("locked.glb", test::square().glb());
    std::filesystem::permissions(locked, std::filesystem::perms::none);
    if (!std::ifstream(locked)) {  // the superuser may read anything
        expect_error(locked, "cannot be read");
    }
}

TEST(GltfErrors, FilesOfAnotherKind) {
    const TemporaryFolder folder;
    expect_error(folder.write("a.glb", "x"), "not a glTF file");
    expect_error(folder.write("b.glb", "\x89PNG\r\n\x1a\n and more"), "not a glTF file");
    expect_error(folder.write("c.gltf", "[1, 2]"), "not a glTF file");
    expect_error(folder.write("d.gltf", "{}"), "expected a JSON object with the member 'asset'");
}

TEST(GltfErrors, BrokenJsonIsOneLine) {
    const TemporaryFolder folder;
    expect_error(folder.write("a.gltf", "{\n\"asset\": {\n\x01\n}"),
                 "the JSON is broken: parse error at line 3");
    expect_error(folder.write("b.gltf", "{\"asset\""), "the JSON is broken");
    expect_error(folder.write("c.gltf", "{\"asset\": \"\xff\xfe\"}"), "the JSON is broken");
    expect_error(folder.write("d.gltf", "{\"a\": 1e999}"), "the JSON is broken");
}

TEST(GltfErrors, JsonNestedWithoutEndDoesNotExhaustTheStack) {
    const TemporaryFolder folder;
    const std::string open(1'000'000, '[');
    expect_error(folder.write("a.gltf", "{\"extras\": " + open), "at most 64 levels");
}

TEST(GltfErrors, TruncatedGlb) {
    const TemporaryFolder folder;
    const std::string glb = test::square().glb();
    expect_error(folder.write("a.glb", glb.substr(0, 16)),
                 "truncated: a GLB has at least 20 bytes, found 16");
    expect_error(
        folder.write("b.glb", glb.substr(0, glb.size() - 1)),
        fmt::format("truncated: the GLB header says {} bytes, the file has {}", glb.size(), glb.size() - 1));
}

TEST(GltfErrors, WrongGlbStructure) {
    const TemporaryFolder folder;
    std::string glb = test::square().glb();
    expect_error(folder.write("a.glb", std::string(glb).replace(4, 4, GltfBuilder::uint32(1))),
                 "expected glTF version 2, found version 1");
    expect_error(folder.write("b.glb", std::string(glb).replace(12, 4, GltfBuilder::uint32(0xffff'fff0))),
                 "the chunk at byte 12 has 4294967280 bytes");
    expect_error(folder.write("c.glb", std::string(glb).replace(16, 4, "TEXT")),
                 "first GLB chunk to be JSON");
}

TEST(GltfErrors, Versions) {
    expect_error([](GltfBuilder& b) { b.document["asset"]["version"] = "1.0"; },
                 "expected glTF version 2.x, found");
    expect_error([](GltfBuilder& b) { b.document["asset"]["version"] = 2.0; },
                 "asset.version: expected a string");
    expect_error([](GltfBuilder& b) { b.document["asset"]["minVersion"] = "2.1"; },
                 "needs a reader of glTF 2.1");
}

TEST(GltfErrors, RequiredExtensionsThatChangeGeometry) {
    for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                  "KHR_mesh_quantization", "EXT_mesh_gpu_instancing"}) {
        expect_error([&](GltfBuilder& b) { b.document["extensionsRequired"] = {extension}; },
                     std::string("requires the extension ") + extension);
    }
}

TEST(GltfErrors, IndexOutOfRangeNamesItsPlace) {
    GltfBuilder builder = test::square();
    const std::size_t indices = builder.add_indices(std::vector<std::uint32_t>{0, 1, 2, 0, 4, 3});
    builder.document["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", 0}}}, {"indices", indices}});
    expect_error(builder, "mesh 0, primitive 1: index 4 is 4, expected below 4, the number of vertices");
}

TEST(GltfErrors, PositionsThatAreNotFinite) {
    for (const float bad : {NAN, INFINITY, -INFINITY}) {
        GltfBuilder builder;
        const std::size_t positions = builder.add_positions({{0, 0, 0}, {1, bad, 0}, {0, 1, 0}});
        builder.add_mesh({{"attributes", {{"POSITION", positions}}}});
        expect_error(builder, "mesh 0, primitive 0, accessor 0: position 1 is (1, ");
    }
}

TEST(GltfErrors, TransformsThatOverflow) {
    expect_error(
        [](GltfBuilder& b) {
            b.document["nodes"][0]["scale"] = {1e300, 1e300, 1};
        },
        "position 1 leaves the range of float");
    expect_error(
        [](GltfBuilder& b) {
            b.document["nodes"][0]["rotation"] = {0, 0, 0, 0};
        },
        "unit quaternion");
    expect_error([](GltfBuilder& b) { b.document["nodes"][0]["matrix"] = std::vector<int>(16, 1); },
                 "nodes[0].matrix: expected the last row 0 0 0 1");
    expect_error(
        [](GltfBuilder& b) {
            b.document["nodes"][0]["matrix"] = {1, 2, 3};
        },
        "expected 16 numbers, found 3");
}

TEST(GltfErrors, RangesBeyondTheBytes) {
    expect_error([](GltfBuilder& b) { b.document["accessors"][0]["count"] = 5; },
                 "accessor 0: its 5 elements end at byte 60 of bufferView 0, which has 48");
    expect_error([](GltfBuilder& b) { b.document["accessors"][1]["byteOffset"] = 2; },
                 "accessor 1: its 6 elements end at byte 14 of bufferView 1, which has 12");
    expect_error([](GltfBuilder& b) { b.document["bufferViews"][0]["byteOffset"] = 20; },
                 "bufferView 0 ends at byte 68 of buffer 0, which has 60");
    expect_error([](GltfBuilder& b) { b.document["bufferViews"][0]["byteStride"] = 8; },
                 "the byteStride of bufferView 0 is 8, below the element size of 12");
    expect_error(
        [](GltfBuilder& b) {
            b.document["buffers"] = {{{"byteLength", 64}}};
        },
        "buffers[0] (the GLB binary chunk): expected 64 bytes, found 60");
}

TEST(GltfErrors, ReferencesToWhatDoesNotExist) {
    expect_error([](GltfBuilder& b) { b.document["scene"] = 3; }, "scene 3 does not exist, the file has 1");
    expect_error([](GltfBuilder& b) { b.document["scenes"][0]["nodes"] = {7}; }, "node 7 does not exist");
    expect_error([](GltfBuilder& b) { b.document["nodes"][0]["mesh"] = 2; }, "mesh 2 does not exist");
    expect_error([](GltfBuilder& b) { b.primitive()["attributes"]["POSITION"] = 9; },
                 "accessor 9 does not exist");
    expect_error([](GltfBuilder& b) { b.primitive()["indices"] = 9; }, "out of bounds");
    expect_error([](GltfBuilder& b) { b.document["accessors"][0]["bufferView"] = 5; },
                 "bufferView 5 does not exist");
    expect_error([](GltfBuilder& b) { b.document["bufferViews"][0]["buffer"] = 5; },
                 "buffer 5 of bufferView 0");
}

TEST(GltfErrors, WrongAccessorTypes) {
    expect_error([](GltfBuilder& b) { b.document["accessors"][0]["type"] = "VEC2"; },
                 "expected positions of type VEC3");
    expect_error([](GltfBuilder& b) { b.document["accessors"][0]["componentType"] = 5123; },
                 "5126 (float), found");
    expect_error([](GltfBuilder& b) { b.document["accessors"][1]["componentType"] = 5126; },
                 "expected indices of type");
    expect_error([](GltfBuilder& b) { b.document["accessors"][1]["componentType"] = 5124; },
                 "expected indices of type");
    expect_error([](GltfBuilder& b) { b.document["accessors"][1]["type"] = "VEC3"; },
                 "expected indices of type");
    expect_error([](GltfBuilder& b) { b.document["accessors"][1]["type"] = "SCALE"; }, "SCALE");
}

TEST(GltfErrors, WrongNumberOfCorners) {
    expect_error([](GltfBuilder& b) { b.document["accessors"][1]["count"] = 5; },
                 "expected a multiple of 3 corners");
    expect_error(
        [](GltfBuilder& b) {
            b.document["accessors"][1]["count"] = 2;
            b.primitive()["mode"] = 5;
        },
        "at least 3 corners in a strip or fan, found 2");
    expect_error([](GltfBuilder& b) { b.primitive()["mode"] = 7; }, "expected a mode from 0 to 6, found 7");
}

TEST(GltfErrors, MembersOfTheWrongTypeAreNotTakenAsAbsent) {
    expect_error([](GltfBuilder& b) { b.document["accessors"][0]["byteOffset"] = -4; },
                 "accessors[0].byteOffset: expected an integer from 0 to 2^32 - 1, found -4");
    expect_error([](GltfBuilder& b) { b.primitive()["indices"] = 1.5; },
                 "meshes[0].primitives[0].indices: expected an integer from 0 to 2^31 - 1, found 1.5");
    expect_error([](GltfBuilder& b) { b.primitive()["indices"] = std::uint64_t{1} << 32; },
                 "found 4294967296");
    expect_error([](GltfBuilder& b) { b.primitive().erase("attributes"); },
                 "expected the member 'attributes'");
    expect_error([](GltfBuilder& b) { b.document["nodes"][0]["children"] = {"a"}; },
                 "nodes[0].children: expected");
    expect_error([](GltfBuilder& b) { b.document["nodes"] = 5; }, "nodes: expected an array, found number");
    expect_error([](GltfBuilder& b) { b.document["meshes"] = {7}; },
                 "meshes[0]: expected an object, found number");
}

TEST(GltfErrors, AbsurdCountsAreRefusedBeforeAnyAllocation) {
    expect_error([](GltfBuilder& b) { b.document["accessors"][0]["count"] = 4'000'000'000U; },
                 "its 4000000000 elements");
    expect_error([](GltfBuilder& b) { b.document["accessors"][1]["count"] = 4'000'000'000U; },
                 "its 4000000000 elements");
    expect_error([](GltfBuilder& b) { b.document["accessors"][0]["count"] = std::uint64_t{1} << 63U; },
                 "2^32 - 1");
    expect_error(
        [](GltfBuilder& b) {
            b.document["buffers"] = {{{"byteLength", 4'294'967'295U}}};
        },
        "expected 4294967295 bytes, found 60");
    const auto claim_zeros = [](std::uint64_t count) {
        return [count](GltfBuilder& b) {
            b.document["accessors"][0].erase("bufferView");
            b.document["accessors"][0]["count"] = count;
        };
    };
    expect_error(claim_zeros(4'000'000'000U),
                 "at most 16777216 elements without a bufferView, found 4000000000");
    expect_error(
        [&](GltfBuilder& b) {
            claim_zeros(4'000'000'000U)(b);
            b.document["accessors"][0]["sparse"] = {{"count", 1},
                                                    {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                                    {"values", {{"bufferView", 0}}}};
        },
        "at most 16777216 elements without a bufferView");
}

TEST(GltfErrors, SparseElementsOutOfRange) {
    const auto sparse = [](json changes) {
        return [changes = std::move(changes)](GltfBuilder& b) {
            json part = {{"count", 1},
                         {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                         {"values", {{"bufferView", 0}}}};
            part.merge_patch(changes);
            b.document["accessors"][0]["sparse"] = part;
        };
    };
    expect_error(sparse({{"count", 2'000'000'000}}), "sparse indices: its 2000000000 elements end");
    expect_error(sparse({{"indices", {{"componentType", 5126}}}}),
                 "expected sparse indices of componentType");
    expect_error(sparse({{"indices", {{"componentType", 5125}}}}),
                 "sparse index 0 is 65536, expected below 4");
    expect_error(sparse({{"values", {{"byteOffset", 40}}}}), "sparse values: its 1 elements end at byte 52");
    expect_error(sparse({{"values", {{"bufferView", 8}}}}), "bufferView 8 does not exist");
    expect_error(sparse({{"count", -1}}), "accessors[0].sparse.count: expected an integer");
}

TEST(GltfErrors, HierarchiesThatAreNoTree) {
    expect_error([](GltfBuilder& b) { b.document["nodes"][0]["children"] = {0}; },
                 "nodes[0]: expected a tree");
    expect_error(
        [](GltfBuilder& b) {
            b.document["nodes"] = {
                {{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}, {"mesh", 0}}};
        },
        "a node with two parents or a cycle");
    // Forty levels of two references each would be 2^40 instances.
    expect_error(
        [](GltfBuilder& b) {
            json nodes = json::array();
            for (int i = 1; i <= 40; ++i) {
                nodes.push_back({{"children", {i, i}}});
            }
            nodes.push_back({{"mesh", 0}});
            b.document["nodes"] = nodes;
        },
        "expected a tree of nodes");
}

TEST(GltfErrors, MoreInstancesThanTheMachineCanHold) {
    expect_error(
        [](GltfBuilder& b) {
            b.document["accessors"].push_back({{"componentType", test::component_float},
                                               {"count", max_scene_elements / 16 / 3 * 3},
                                               {"type", "VEC3"}});
            b.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 2}}}});
            json nodes = json::array();
            json roots = json::array();
            for (int i = 0; i < 1'000; ++i) {
                nodes.push_back({{"mesh", 0}});
                roots.push_back(i);
            }
            b.document["nodes"] = nodes;
            b.document["scenes"][0]["nodes"] = roots;
        },
        "expected at most 268435456 triangles");
}

TEST(GltfErrors, ExternalBuffersThatAreMissingOrShort) {
    const TemporaryFolder folder;
    GltfBuilder builder = test::square();
    builder.document["buffers"] = {{{"byteLength", 60}, {"uri", "data.bin"}}};
    const std::filesystem::path file = folder.write("scene.gltf", builder.gltf());
    expect_error(file, "data.bin: no such file");
    static_cast<void>(folder.write("data.bin", builder.bytes.substr(1)));
    expect_error(file, "data.bin: expected 60 bytes, found 59");
    std::filesystem::remove(folder.path() / "data.bin");
    std::filesystem::create_directory(folder.path() / "data.bin");
    expect_error(file, "expected a file, found a directory");
}

TEST(GltfErrors, ExternalBuffersOutsideTheFolder) {
    const TemporaryFolder folder;
    GltfBuilder builder = test::square();
    std::filesystem::create_directory(folder.path() / "inner");
    const std::filesystem::path outside = folder.write("outside.bin", builder.bytes);
    std::filesystem::create_symlink(outside, folder.path() / "inner/link.bin");
    for (const std::string& uri :
         {std::string("../outside.bin"), std::string("%2e%2e/outside.bin"),
          std::string("a/../../outside.bin"), outside.string(), std::string("link.bin"),
          std::string("http://example.org/outside.bin"), "file://" + outside.string()}) {
        builder.document["buffers"] = {{{"byteLength", 60}, {"uri", uri}}};
        expect_error(folder.write("inner/scene.gltf", builder.gltf()),
                     "expected a file in the folder of the glTF file");
    }
}

TEST(GltfErrors, BuffersWithoutBytes) {
    const TemporaryFolder folder;
    GltfBuilder builder = test::square();
    const auto expect = [&](const json& buffers, const std::string& text) {
        builder.document["buffers"] = buffers;
        expect_error(folder.write("scene.gltf", builder.gltf()), text);
    };
    expect({{{"byteLength", 60}}}, "buffers[0]: expected a uri or a GLB binary chunk");
    expect({{{"byteLength", 0}, {"uri", "data.bin"}}}, "buffers[0].byteLength: expected at least 1");
    expect({{{"byteLength", 60}, {"uri", "data:text/html,hello"}}}, "expected a base64 data URI");
    expect({{{"byteLength", 60}, {"uri", "data:application/octet-stream;base64,AAAA"}}},
           "expected 60 bytes, found 3");
    expect({{{"byteLength", 60}, {"uri", "data:application/octet-stream;base64,!"}}},
           "expected a base64 data URI");
}

TEST(GltfErrors, ScenesWithNothingToHit) {
    expect_error([](GltfBuilder& b) { b.document["nodes"][0].erase("mesh"); },
                 "expected triangles in the default scene");
    expect_error([](GltfBuilder& b) { b.document["scenes"][0].erase("nodes"); },
                 "expected triangles in the default");
    expect_error([](GltfBuilder& b) { b.primitive()["mode"] = 1; },
                 "expected triangles in the default scene");
    expect_error(
        [](GltfBuilder& b) {
            b.document["nodes"][0]["scale"] = {0, 1, 1};
        },
        "found 2 degenerate triangles only");
}

TEST(GltfErrors, ScenesTooLargeOrTooSmallForBinary32) {
    const auto scaled = [](double factor) {
        GltfBuilder builder = test::square();
        builder.document["nodes"][0]["scale"] = {factor, factor, factor};
        return builder;
    };
    expect_error(scaled(1.01e11), "expected coordinates of at most 1e+11");
    expect_error(scaled(-1.01e11), "expected coordinates of at most 1e+11");
    expect_error(scaled(3e38), "found 3e+38");
    expect_error(scaled(0.7e-9), "expected a scene of at least 1e-09 across");
    const TemporaryFolder folder;
    for (const double factor : {1e11, -1e11, 0.71e-9}) {
        const auto file = folder.write("scene.glb", scaled(factor).glb());
        EXPECT_EQ(error_of(file), "loaded 2 triangles") << factor;
    }
}

/// Loads what may be broken: it must load or say so in one line.
void expect_load_or_error(const std::filesystem::path& file) {
    try {
        static_cast<void>(load_gltf(file));
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), AllOf(StartsWith(file.string() + ": "), Not(HasSubstr("\n"))));
    }
}

TEST(GltfErrors, EveryTruncationOfAGlbIsAnError) {
    const TemporaryFolder folder;
    const std::string glb = test::square().glb();
    for (std::size_t size = 0; size < glb.size(); ++size) {
        EXPECT_THROW(static_cast<void>(load_gltf(folder.write("cut.glb", glb.substr(0, size)))), Error)
            << size;
    }
}

TEST(GltfErrors, EveryDamagedByteLoadsOrIsAnError) {
    const TemporaryFolder folder;
    for (const std::string& whole : {test::square().glb(), test::square().gltf()}) {
        for (std::size_t i = 0; i < whole.size(); ++i) {
            for (const unsigned flip : {0x01U, 0x80U, 0xffU}) {
                std::string damaged = whole;
                damaged[i] = static_cast<char>(static_cast<unsigned char>(damaged[i]) ^ flip);
                expect_load_or_error(folder.write("damaged.glb", damaged));
            }
        }
    }
}

TEST(GltfErrors, EveryMemberOfEveryKindOfValueLoadsOrIsAnError) {
    const TemporaryFolder folder;
    const json whole = test::square().document;
    const std::vector<json> values{nullptr,       true,          -1, 0, 1, 2'147'483'648U, 1e300, "", "x",
                                   json::array(), json::object()};
    const json flat = whole.flatten();
    for (const auto& [pointer, old] : flat.items()) {
        for (const json& value : values) {
            GltfBuilder builder = test::square();
            builder.document[json::json_pointer(pointer)] = value;
            expect_load_or_error(folder.write("odd.glb", builder.glb()));
        }
    }
}

}  // namespace
}  // namespace rtu::model
