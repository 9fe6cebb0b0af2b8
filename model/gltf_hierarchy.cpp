#include "model/gltf_hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "model/error.hpp"

namespace rtu::model {

namespace {

/// The map of a column-major 4x4 matrix.
Affine from_matrix(const std::vector<double>& m, const std::string& where) {
    // Exporters compute the last row, so it is 0 0 0 1 only up to the rounding of their floats.
    constexpr double slack = 1e-5;
    if (std::fabs(m[3]) > slack || std::fabs(m[7]) > slack || std::fabs(m[11]) > slack ||
        std::fabs(m[15] - 1) > slack) {
        throw Error("{}.matrix: expected the last row 0 0 0 1, found {} {} {} {}", where, m[3], m[7], m[11],
                    m[15]);
    }
    Affine map;
    for (std::size_t r = 0; r < 3; ++r) {
        map.rows[r] = {m[r], m[4 + r], m[8 + r], m[12 + r]};
    }
    return map;
}

/// The map of a quaternion (x, y, z, w) of any length but zero: a rounded one still gives a rotation.
Affine from_rotation(const std::vector<double>& q, const std::string& where) {
    const double x = q[0];
    const double y = q[1];
    const double z = q[2];
    const double w = q[3];
    const double squared_length = x * x + y * y + z * z + w * w;
    if (!(squared_length > 0) || !std::isfinite(squared_length)) {
        throw Error("{}.rotation: expected a unit quaternion, found {} {} {} {}", where, x, y, z, w);
    }
    const double s = 2 / squared_length;
    return {{{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y), 0},
              {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x), 0},
              {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y), 0}}}};
}

Affine to_parent(const tinygltf::Node& node, const std::string& where) {
    if (!node.matrix.empty()) {
        return from_matrix(node.matrix, where);
    }
    Affine map;
    if (!node.translation.empty()) {
        for (std::size_t r = 0; r < 3; ++r) {
            map.rows[r][3] = node.translation[r];
        }
    }
    if (!node.rotation.empty()) {
        map = map * from_rotation(node.rotation, where);
    }
    if (!node.scale.empty()) {
        Affine scale;
        for (std::size_t r = 0; r < 3; ++r) {
            scale.rows[r][r] = node.scale[r];
        }
        map = map * scale;
    }
    return map;
}

std::vector<int> root_nodes(const tinygltf::Model& model) {
    std::vector<bool> is_child(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            if (std::size_t(child) < is_child.size()) {
                is_child[std::size_t(child)] = true;
            }
        }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
        if (!is_child[i]) {
            roots.push_back(int(i));
        }
    }
    return roots;
}

std::vector<int> scene_roots(const tinygltf::Model& model, const std::string& name) {
    if (model.scenes.empty() && model.defaultScene < 0) {
        return root_nodes(model);
    }
    const auto scene = std::size_t(std::max(model.defaultScene, 0));
    if (scene >= model.scenes.size()) {
        throw Error("{}: scene {} does not exist, the file has {}", name, scene, model.scenes.size());
    }
    return model.scenes[scene].nodes;
}

/// A node that waits to be visited. The wait list replaces recursion: a hierarchy may be as deep as the file
/// is long.
struct Visit {
    int node;
    Affine parent_to_world;
};

}  // namespace

std::vector<MeshInstance> mesh_instances(const tinygltf::Model& model, const std::string& name) {
    std::vector<Visit> waiting;
    const auto push = [&](const std::vector<int>& nodes, const Affine& parent_to_world) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
            waiting.push_back({*node, parent_to_world});
        }
    };
    push(scene_roots(model, name), Affine{});
    std::vector<bool> is_visited(model.nodes.size());
    std::vector<MeshInstance> instances;
    while (!waiting.empty()) {
        const Visit visit = waiting.back();
        waiting.pop_back();
        const auto index = std::size_t(visit.node);
        if (index >= model.nodes.size()) {
            throw Error("{}: node {} does not exist, the file has {}", name, index, model.nodes.size());
        }
        const std::string where = fmt::format("{}: nodes[{}]", name, index);
        if (is_visited[index]) {
            throw Error("{}: expected a tree of nodes, found a node with two parents or a cycle", where);
        }
        is_visited[index] = true;
        const tinygltf::Node& node = model.nodes[index];
        const Affine to_world = visit.parent_to_world * to_parent(node, where);
        if (node.mesh >= 0) {
            const auto mesh = std::size_t(node.mesh);
            if (mesh >= model.meshes.size()) {
                throw Error("{}: mesh {} does not exist, the file has {}", where, mesh, model.meshes.size());
            }
            instances.push_back({mesh, to_world});
        }
        push(node.children, to_world);
    }
    return instances;
}

}  // namespace rtu::model
