#include "study/methods/method_charts_rows.hpp"

#include <cmath>
#include <limits>

#include "model/parallel.hpp"
#include "study/stability/stability_aims.hpp"

namespace rtu::study {
namespace {

using model::Ray;
using model::Vec3;
using model::methods::Corners;
using model::methods::Method;

constexpr std::uint32_t offset_purpose = 0x6f66;
constexpr float ball_radius = 16;

// Hits of a ray on a closed mesh; a one-sided method is asked for both windings.
std::uint32_t hits_of(const Method& method, const Ray& ray, std::span<const Corners> triangles) {
    std::uint32_t hits = 0;
    for (const Corners& triangle : triangles) {
        const auto& [a, b, c] = triangle;
        const bool is_hit =
            method.test(ray, triangle) || (method.info.is_one_sided && method.test(ray, {a, c, b}));
        hits += is_hit ? 1 : 0;
    }
    return hits;
}

// None is worse than an even number, and that is worse than an odd one.
int badness(std::uint32_t hits) { return hits == 0 ? 2 : hits % 2 == 0 ? 1 : 0; }

// The rays of a picture, and the pixel of each.
struct PictureRays {
    std::uint32_t width, height;
    Vec3 eye;
    std::vector<Ray> rays;
    std::vector<std::size_t> pixels;

    // Towards -z, 90 degrees wide and high; rays that leave the picture are left out.
    void add(Vec3 direction) {
        if (!(direction.z < 0)) return;
        const float x = direction.x / -direction.z, y = -direction.y / -direction.z;
        if (!(std::abs(x) < 1 && std::abs(y) < 1)) return;
        const auto column = std::size_t((x + 1) / 2 * float(width)),
                   row = std::size_t((y + 1) / 2 * float(height));
        rays.push_back({eye, 0, direction, std::numeric_limits<float>::infinity()});
        pixels.push_back(std::min<std::size_t>(row, height - 1) * width +
                         std::min<std::size_t>(column, width - 1));
    }
};

PictureRays picture_rays(const model::TriangleMesh& mesh, std::uint32_t width, std::uint32_t height) {
    PictureRays view{width, height, {0.01F, -0.02F, 0.03F}, {}, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            view.add(
                {(float(x) + 0.5F) / float(width) * 2 - 1, 1 - (float(y) + 0.5F) / float(height) * 2, -1});
        }
    }
    const std::uint32_t steps = width / 2;
    for (const model::Triangle& t : mesh.triangles) {
        for (std::size_t side = 0; side < 3; ++side) {
            if (t[side] > t[(side + 1) % 3]) continue;  // the neighbour has it
            const Vec3 a = mesh.positions[t[side]], b = mesh.positions[t[(side + 1) % 3]];
            for (std::uint32_t i = 0; i <= steps; ++i) {
                const Vec3 aim = i == steps ? b : a + (b - a) * (float(i) / float(steps));
                view.add(aim - view.eye);
            }
        }
    }
    return view;
}

}  // namespace

std::vector<OffsetRow> measure_offsets(std::uint32_t rays, std::uint64_t seed) {
    const std::span<const Method> methods = model::methods::all_methods();
    const ClosedMesh& ball = closed_mesh("ball");
    std::vector<OffsetRow> rows;
    for (const auto& [aim, name] : {std::pair(Aim::Edge, "edge"), std::pair(Aim::Vertex, "vertex")}) {
        for (int decade = 0; decade <= 7; ++decade) {
            const auto offset = float(std::pow(10.0, decade));
            const Placement placement{ball_radius, {offset, -offset, offset / 2}};
            const auto surface = placed_surface(ball.make(), placement);
            const DrawRay draw = rays_at(surface, ball.inner_radius, placement, aim);
            const std::size_t first = rows.size();
            for (const Method& method : methods) {
                rows.push_back({std::string(method.info.name), double(offset), name, rays, 0, 0});
            }
            model::for_each_range<std::size_t>(methods.size(), 1, [&](const auto& range) {
                for (std::size_t m = range.begin(); m != range.end(); ++m) {
                    OffsetRow& row = rows[first + m];
                    for (std::uint32_t i = 0; i < rays; ++i) {
                        model::RandomStream random(seed, offset_purpose + std::uint32_t(decade), i);
                        const std::uint32_t hits = hits_of(methods[m], draw(random), surface->corners);
                        row.leaks += hits == 0 ? 1 : 0;
                        row.doubles += hits > 1 ? 1 : 0;
                    }
                }
            });
        }
    }
    return rows;
}

std::vector<ParityMap> parity_maps(std::span<const std::string> methods, std::uint32_t width,
                                   std::uint32_t height) {
    const model::TriangleMesh mesh = closed_mesh("spiky").make();
    std::vector<Corners> triangles;
    for (const model::Triangle& t : mesh.triangles) {
        triangles.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
    }
    const PictureRays view = picture_rays(mesh, width, height);
    std::vector<ParityMap> maps(methods.size());
    model::for_each_range<std::size_t>(methods.size(), 1, [&](const auto& range) {
        for (std::size_t m = range.begin(); m != range.end(); ++m) {
            const Method& method = *model::methods::find_method(methods[m]);
            maps[m] = {methods[m], std::vector<std::uint32_t>(std::size_t(width) * height, 1)};
            for (std::size_t i = 0; i < view.rays.size(); ++i) {
                const std::uint32_t hits = hits_of(method, view.rays[i], triangles);
                std::uint32_t& shown = maps[m].hits[view.pixels[i]];
                if (badness(hits) > badness(shown)) shown = hits;
            }
        }
    });
    return maps;
}

}  // namespace rtu::study
