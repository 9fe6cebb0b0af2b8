#include <cstdint>

#include "model/builtin_sculptures.hpp"
#include "model/mesh_builder.hpp"
#include "model/random.hpp"

namespace rtu::model {

namespace {

/// A direction of length 1, uniform on the sphere.
Vec3 random_direction(RandomStream& random) {
    for (;;) {
        const Vec3 p{2 * random.next() - 1, 2 * random.next() - 1, 2 * random.next() - 1};
        const float squared_length = dot(p, p);
        if (squared_length > 0.01F && squared_length < 1) {
            return normalized(p);
        }
    }
}

/// A ribbon that leaves the core outwards and curls. Returns the number of the first of its last two
/// vertices.
std::uint32_t add_ribbon(MeshBuilder& mesh, RandomStream random) {
    constexpr int quads = 32;
    constexpr float core_radius = 0.15F;
    constexpr float step = 0.045F;
    constexpr float curl = 2.2F;  ///< turn per unit of length
    constexpr float jitter = 0.15F;
    constexpr float half_width = 0.008F;
    Vec3 direction = random_direction(random);
    Vec3 position = core_radius * direction;
    const Vec3 axis = random_direction(random);
    std::uint32_t last = 0;
    for (int i = 0; i <= quads; ++i) {
        const Vec3 side = half_width * normalized(cross(direction, axis));
        last = mesh.add_vertex(position - side);
        mesh.add_vertex(position + side);
        if (i > 0) {
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last, last - 1, last + 1);
        }
        // Turning around the axis keeps the ribbon flat; the jitter keeps any two ribbons apart.
        direction =
            normalized(direction + curl * step * cross(axis, direction) + jitter * random_direction(random));
        position = position + step * direction;
    }
    return last;
}

}  // namespace

TriangleMesh hairball() {
    constexpr std::uint32_t ribbons = 600;
    constexpr std::uint32_t seed = 7;
    MeshBuilder mesh;
    for (std::uint32_t i = 0; i < ribbons; ++i) {
        const std::uint32_t last = add_ribbon(mesh, RandomStream(seed, 0, i));
        if (i % 6 == 5) {
            mesh.add_triangle(last, last + 1, last + 1);
        }
    }
    return mesh.take();
}

}  // namespace rtu::model
