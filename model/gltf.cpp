#include "model/gltf.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "model/error.hpp"
#include "model/gltf_document.hpp"
#include "model/gltf_hierarchy.hpp"
#include "model/gltf_primitive.hpp"
#include "model/one_line.hpp"
#include "model/sampling.hpp"

namespace rtu::model {

namespace {

std::string place(const std::string& name, std::size_t mesh, std::size_t primitive) {
    return fmt::format("{}: mesh {}, primitive {}", name, mesh, primitive);
}

/// Adds up what the instances will need, before anything is allocated for them.
PrimitiveSize checked_total(const tinygltf::Model& model, const std::vector<MeshInstance>& instances,
                            const std::string& name) {
    PrimitiveSize total;
    for (const MeshInstance& instance : instances) {
        const std::vector<tinygltf::Primitive>& primitives = model.meshes[instance.mesh].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            const PrimitiveSize size = checked_size(model, primitives[i], place(name, instance.mesh, i));
            total.vertex_count += size.vertex_count;
            total.triangle_count += size.triangle_count;
            if (std::max(total.vertex_count, total.triangle_count) > max_scene_elements) {
                throw Error("{}: expected at most {} triangles and as many vertices, found more", name,
                            max_scene_elements);
            }
        }
    }
    return total;
}

void append(TriangleMesh& mesh, const PrimitiveGeometry& geometry, const Affine& to_world,
            const std::string& where) {
    const auto first_vertex = std::uint32_t(mesh.positions.size());
    const bool is_identity = to_world == Affine{};
    for (const Vec3 local : geometry.positions) {
        const Vec3 position = is_identity ? local : transform(to_world, local);
        if (!is_finite(position)) {
            throw Error("{}: position {} leaves the range of float when its node's transform is applied",
                        where, mesh.positions.size() - first_vertex);
        }
        mesh.positions.push_back(position);
    }
    const bool is_mirrored = is_mirror(to_world);
    for (const auto& [a, b, c] : geometry.triangles) {
        mesh.triangles.push_back(
            {first_vertex + a, first_vertex + (is_mirrored ? c : b), first_vertex + (is_mirrored ? b : c)});
    }
}

TriangleMesh flatten(const tinygltf::Model& model, const std::string& name) {
    const std::vector<MeshInstance> instances = mesh_instances(model, name);
    const PrimitiveSize total = checked_total(model, instances, name);
    TriangleMesh mesh;
    mesh.positions.reserve(total.vertex_count);
    mesh.triangles.reserve(total.triangle_count);
    for (const MeshInstance& instance : instances) {
        const std::vector<tinygltf::Primitive>& primitives = model.meshes[instance.mesh].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            const std::string where = place(name, instance.mesh, i);
            append(mesh, read_primitive(model, primitives[i], where), instance.to_world, where);
        }
    }
    return mesh;
}

void check_size(const TriangleMesh& mesh, const std::string& name) {
    const Aabb box = bounds(mesh);
    float largest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        largest = std::max({largest, -box.lo[axis], box.hi[axis]});
    }
    if (largest > max_coordinate) {
        throw Error(
            "{}: expected coordinates of at most {:g}, found {:g}: binary32 arithmetic would overflow", name,
            max_coordinate, largest);
    }
    if (const float diagonal = distance_between(box.lo, box.hi); diagonal < min_diagonal) {
        throw Error(
            "{}: expected a scene of at least {:g} across, found {:g}: binary32 arithmetic would underflow",
            name, min_diagonal, diagonal);
    }
}

}  // namespace

TriangleMesh load_gltf(const std::filesystem::path& file) {
    const std::string name = one_line(file.string());
    try {
        TriangleMesh mesh = flatten(load_gltf_document(file), name);
        mesh.name = file.stem().string();
        if (mesh.triangles.empty()) {
            throw Error("{}: expected triangles in the default scene, found none", name);
        }
        if (std::ranges::all_of(mesh.triangles, [&](const Triangle& t) { return is_degenerate(mesh, t); })) {
            throw Error("{}: expected a triangle with an area, found {} degenerate triangles only", name,
                        mesh.triangles.size());
        }
        check_size(mesh, name);
        return mesh;
    } catch (const std::bad_alloc&) {
        throw Error("{}: not enough memory to read the scene", name);
    }
}

}  // namespace rtu::model
