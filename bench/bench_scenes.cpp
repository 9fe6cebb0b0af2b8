#include "bench_scenes.hpp"

#include <map>

#include "model/builtin_scene.hpp"
#include "model/bvh.hpp"
#include "model/gltf.hpp"
#include "model/pairing.hpp"
#include "tests/scenes.hpp"

namespace rtu::bench {

namespace {

model::Camera camera_of(const std::string& name, const model::TriangleMesh& mesh,
                        const model::MemoryImage& image) {
    if (name == "builtin") return model::builtin_camera();
    if (const auto file = test::scene_file("scenes.toml")) {
        if (const auto camera = model::load_camera(*file, name)) return *camera;
    }
    return model::automatic_camera(mesh, image);
}

BuiltScene build(const std::string& name) {
    model::TriangleMesh mesh = load_scene(name);
    model::MemoryImage image = model::build_bvh(
        mesh, pair_triangles(mesh, {model::PairingKind::EdgeBbsa, 0}, model::EdgeIdentity::Position), {});
    model::Camera camera = camera_of(name, mesh, image);
    return {std::move(mesh), std::move(image), camera};
}

}  // namespace

bool has_scene(const std::string& name) {
    return name == "builtin" || test::scene_file(name + ".glb").has_value();
}

model::TriangleMesh load_scene(const std::string& name) {
    return name == "builtin" ? model::builtin_scene() : model::load_gltf(*test::scene_file(name + ".glb"));
}

const BuiltScene& built_scene(const std::string& name) {
    static std::map<std::string, BuiltScene> scenes;
    auto entry = scenes.find(name);
    if (entry == scenes.end()) entry = scenes.emplace(name, build(name)).first;
    return entry->second;
}

}  // namespace rtu::bench
