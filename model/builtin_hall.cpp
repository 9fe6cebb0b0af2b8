#include "model/builtin_hall.hpp"

#include <array>

#include "model/mesh_builder.hpp"
#include "model/unit_circle.hpp"

namespace rtu::model {

namespace {

constexpr float half_length = 12.0F;  // along x
constexpr float half_width = 5.0F;    // along z
constexpr float height = 7.0F;
constexpr float wall = 0.4F;
constexpr float bay = 4.0F;  // from column to column
constexpr int bay_count = 6;
constexpr float arcade_z = 3.0F;
constexpr float spring_y = 4.0F;  // where the columns end and the arches begin
constexpr float window_half_width = 1.25F;
constexpr float sill_y = 1.25F;
constexpr float lintel_y = 4.75F;

float bay_centre(int index) { return -half_length + bay * (float(index) + 0.5F); }

/// Half-metre tiles with bevelled edges.
void add_floor(MeshBuilder& mesh) {
    constexpr float size = 0.5F;
    constexpr float bevel = 0.015625F;
    for (int row = 0; row < int(2 * half_width / size); ++row) {
        for (int column = 0; column < int(2 * half_length / size); ++column) {
            const Vec3 lo{-half_length + size * float(column), -bevel, -half_width + size * float(row)};
            std::array<Vec3, 8> corners;
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const float inset = (k & 2U) != 0 ? bevel : 0.0F;
                corners[k] = lo + Vec3{(k & 1U) != 0 ? size - inset : inset, (k & 2U) != 0 ? bevel : 0.0F,
                                       (k & 4U) != 0 ? size - inset : inset};
            }
            mesh.add_hexahedron(corners);
        }
    }
}

/// Slats across one window, each with a triangle of no area along its front edge.
void add_blinds(MeshBuilder& mesh, float x, float z) {
    constexpr int slat_count = 16;
    constexpr float depth = 0.14F;
    constexpr float drop = 0.09F;
    constexpr float thickness = 0.012F;
    const float x0 = x - window_half_width;
    const float x1 = x + window_half_width;
    for (int i = 0; i < slat_count; ++i) {
        const float y = sill_y + (lintel_y - sill_y) * (float(i) + 0.5F) / float(slat_count);
        std::array<Vec3, 8> corners;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const bool is_front = (k & 4U) != 0;
            corners[k] = {(k & 1U) != 0 ? x1 : x0,
                          y + (is_front ? -drop : drop) + ((k & 2U) != 0 ? thickness : 0.0F),
                          z + (is_front ? depth : -depth)};
        }
        mesh.add_hexahedron(corners);
        const std::uint32_t first = mesh.add_vertex(corners[4]);
        mesh.add_vertex(corners[5]);
        mesh.add_vertex({x, corners[4].y, corners[4].z});
        mesh.add_triangle(first, first + 1, first + 2);
    }
}

/// One bay of a side wall: the four pieces around its window, and the blinds in it. `side` is -1 or 1.
void add_window_bay(MeshBuilder& mesh, float x, float side) {
    const float z0 = side < 0 ? -half_width - wall : half_width;
    const float z1 = z0 + wall;
    const float left = x - 0.5F * bay;
    const float right = x + 0.5F * bay;
    mesh.add_box({left, 0, z0}, {x - window_half_width, height, z1});
    mesh.add_box({x + window_half_width, 0, z0}, {right, height, z1});
    mesh.add_box({x - window_half_width, 0, z0}, {x + window_half_width, sill_y, z1});
    mesh.add_box({x - window_half_width, lintel_y, z0}, {x + window_half_width, height, z1});
    add_blinds(mesh, x, 0.5F * (z0 + z1));
}

void add_end_walls(MeshBuilder& mesh) {
    for (const float side : {-1.0F, 1.0F}) {
        const float x0 = side < 0 ? -half_length - wall : half_length;
        mesh.add_box({x0, 0, -half_width - wall}, {x0 + wall, height, half_width + wall});
        // Upright battens: 3 cm wide, as high as the wall.
        for (int i = 0; i < 25; ++i) {
            const float z = -half_width + 0.4F * (float(i) + 0.5F);
            const float inner = side * half_length;
            mesh.add_box({inner - 0.04F, 0, z - 0.015F}, {inner + 0.04F, height, z + 0.015F});
        }
    }
}

/// The ceiling, joists across the hall, and purlins along all of it.
void add_ceiling(MeshBuilder& mesh) {
    mesh.add_box({-half_length, height, -half_width}, {half_length, height + wall, half_width});
    for (int i = 0; i < 48; ++i) {
        const float x = -half_length + 0.5F * (float(i) + 0.5F);
        mesh.add_box({x - 0.05F, height - 0.25F, -half_width}, {x + 0.05F, height, half_width});
    }
    for (int i = 0; i < 9; ++i) {
        const float z = -half_width + float(i + 1);
        mesh.add_box({-half_length, height - 0.4F, z - 0.06F}, {half_length, height - 0.25F, z + 0.06F});
    }
}

struct ProfilePoint {
    float radius;
    float y;
    float flute;  ///< how much every second point is set back, as a share of the radius
};

/// A column at (x, z): a fluted shaft that is one quad high, between rounded mouldings and square slabs.
void add_column(MeshBuilder& mesh, float x, float z) {
    constexpr std::array<ProfilePoint, 17> profile{{{0.40F, 0.25F, 0},
                                                    {0.46F, 0.28F, 0},
                                                    {0.49F, 0.34F, 0},
                                                    {0.46F, 0.40F, 0},
                                                    {0.39F, 0.43F, 0},
                                                    {0.37F, 0.48F, 0},
                                                    {0.40F, 0.54F, 0},
                                                    {0.36F, 0.58F, 0},
                                                    {0.34F, 0.62F, 0.08F},
                                                    {0.28F, 3.42F, 0.08F},
                                                    {0.29F, 3.46F, 0},
                                                    {0.32F, 3.49F, 0},
                                                    {0.29F, 3.52F, 0},
                                                    {0.30F, 3.58F, 0},
                                                    {0.36F, 3.66F, 0},
                                                    {0.44F, 3.71F, 0},
                                                    {0.46F, 3.75F, 0}}};
    constexpr std::uint32_t sides = 64;
    const std::vector<CirclePoint> circle = unit_circle(sides);
    std::uint32_t below = 0;
    for (std::size_t ring = 0; ring < profile.size(); ++ring) {
        const ProfilePoint& point = profile[ring];
        std::uint32_t above = 0;
        for (std::uint32_t i = 0; i < sides; ++i) {
            const float radius = i % 2 == 0 ? point.radius : point.radius - point.radius * point.flute;
            const std::uint32_t vertex =
                mesh.add_vertex({x + radius * circle[i].cosine, point.y, z + radius * circle[i].sine});
            above = i == 0 ? vertex : above;
        }
        for (std::uint32_t i = 0; ring > 0 && i < sides; ++i) {
            const std::uint32_t next = (i + 1) % sides;
            mesh.add_quad(below + i, above + i, above + next, below + next);
        }
        below = above;
    }
    mesh.add_box({x - 0.5F, 0, z - 0.5F}, {x + 0.5F, 0.25F, z + 0.5F});
    mesh.add_box({x - 0.5F, 3.75F, z - 0.5F}, {x + 0.5F, spring_y, z + 0.5F});
}

/// A half-circle arch over one bay, and the wall above it; the vertices of a face are shared along the arch.
void add_arch(MeshBuilder& mesh, float x, float z) {
    constexpr float radius = 1.6F;
    constexpr float half_thickness = 0.25F;
    constexpr float top_y = 6.0F;
    constexpr std::uint32_t segments = 32;
    const std::vector<CirclePoint> circle = unit_circle(2 * segments);
    std::uint32_t first = 0;
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const float arch_x = x + radius * circle[i].cosine;
        const float arch_y = spring_y + radius * circle[i].sine;
        for (const float face_z : {z - half_thickness, z + half_thickness}) {
            const std::uint32_t vertex = mesh.add_vertex({arch_x, arch_y, face_z});
            mesh.add_vertex({arch_x, top_y, face_z});
            first = i == 0 && face_z < z ? vertex : first;
        }
    }
    for (std::uint32_t i = 0; i < segments; ++i) {
        const std::uint32_t a = first + 4 * i;  // back arch, back top, front arch, front top
        mesh.add_quad(a, a + 4, a + 5, a + 1);
        mesh.add_quad(a + 2, a + 3, a + 7, a + 6);
        mesh.add_quad(a, a + 2, a + 6, a + 4);
    }
    // The piers beside the arch, down to the columns.
    for (const float side : {-1.0F, 1.0F}) {
        const float inner = x + side * radius;
        const float outer = x + side * 0.5F * bay;
        mesh.add_box({side < 0 ? outer : inner, spring_y, z - half_thickness},
                     {side < 0 ? inner : outer, top_y, z + half_thickness});
    }
    mesh.add_box({x - 0.5F * bay, top_y, z - half_thickness - 0.1F},
                 {x + 0.5F * bay, height, z + half_thickness + 0.1F});
}

}  // namespace

TriangleMesh builtin_hall() {
    MeshBuilder mesh;
    add_floor(mesh);
    add_end_walls(mesh);
    add_ceiling(mesh);
    for (const float side : {-1.0F, 1.0F}) {
        for (int i = 0; i < bay_count; ++i) {
            add_window_bay(mesh, bay_centre(i), side);
            add_arch(mesh, bay_centre(i), side * arcade_z);
            if (i > 0) {
                add_column(mesh, bay_centre(i) - 0.5F * bay, side * arcade_z);
            }
        }
    }
    return mesh.take();
}

}  // namespace rtu::model
