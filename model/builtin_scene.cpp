#include "model/builtin_scene.hpp"

#include "model/builtin_hall.hpp"
#include "model/builtin_sculptures.hpp"
#include "model/camera.hpp"
#include "model/mesh_builder.hpp"

namespace rtu::model {

namespace {

/// A square pedestal with a wider slab on it; its top is at `height`.
void add_pedestal(MeshBuilder& mesh, float x, float z, float half_width, float height) {
    constexpr float slab = 0.08F;
    mesh.add_box({x - half_width, 0, z - half_width}, {x + half_width, height - slab, z + half_width});
    const float wide = half_width + slab;
    mesh.add_box({x - wide, height - slab, z - wide}, {x + wide, height, z + wide});
}

}  // namespace

TriangleMesh builtin_scene() {
    MeshBuilder scene;
    scene.add_mesh(builtin_hall());
    add_pedestal(scene, 0.0F, 0.0F, 0.8F, 0.9F);
    scene.add_mesh(placed(shuffled(coral(6), 1), 1.35F, {0.0F, 2.1F, 0.0F}));
    add_pedestal(scene, -4.0F, -1.5F, 0.4F, 0.9F);
    scene.add_mesh(placed(shuffled(with_split_vertices(torus_knot()), 2), 0.22F, {-4.0F, 1.25F, -1.5F}));
    add_pedestal(scene, -4.0F, 1.5F, 0.4F, 0.9F);
    scene.add_mesh(placed(hairball(), 0.6F, {-4.0F, 1.5F, 1.5F}));
    std::uint32_t seed = 3;
    for (const Vec3 centre : {Vec3{-5.7F, 0.3F, -0.8F}, Vec3{-5.4F, 0.2F, 0.5F}, Vec3{-5.0F, 0.15F, 1.0F},
                              Vec3{-2.4F, 0.35F, 0.2F}}) {
        scene.add_mesh(placed(shuffled(icosphere(4), seed++), centre.y, centre));  // the radius is the height
    }
    TriangleMesh mesh = scene.take();
    mesh.name = "builtin";
    return mesh;
}

Camera builtin_camera() {
    return {.eye = {-9.5F, 2.0F, 0.7F}, .target = {0.0F, 2.1F, 0.0F}, .up = {0, 1, 0}, .tan_half_fov = 0.55F};
}

}  // namespace rtu::model
