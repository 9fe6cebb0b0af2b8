// What holds for every method on random and adversarial meshes.

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "model/builtin_scene.hpp"
#include "model/bvh.hpp"
#include "model/camera.hpp"
#include "model/traversal.hpp"
#include "model/workload.hpp"
#include "tests/model/meshes.hpp"
#include "tests/model/pairing_checks.hpp"
#include "tests/model/pairing_meshes.hpp"

namespace rtu::test {
namespace {

using namespace rtu::model;

/// Triangles that all have edge 0-1.
TriangleMesh fan_on_one_edge(std::uint32_t count) {
    Random random(count);
    TriangleMesh mesh{"non-manifold", {{0, 0, 0}, {1, 1, 1}}, {}};
    for (std::uint32_t t = 0; t < count; ++t) {
        mesh.positions.push_back(random.point(-2, 2));
        mesh.triangles.push_back({t % 2, 1 - t % 2, t + 2});
    }
    return mesh;
}

TriangleMesh twice(TriangleMesh mesh) {
    const std::vector<Triangle> triangles = mesh.triangles;
    for (const auto& [a, b, c] : triangles) mesh.triangles.push_back({c, b, a});
    return mesh;
}

/// Triangles around vertex 0, not closed.
TriangleMesh open_fan(std::uint32_t count) {
    TriangleMesh mesh{"open fan", {{0, 1, 0}}, {}};
    for (std::uint32_t i = 0; i <= count; ++i) {
        const float angle = 0.3F * float(i);
        mesh.positions.push_back({std::cos(angle), 0, std::sin(angle)});
        if (i > 0) mesh.triangles.push_back({0, i, i + 1});
    }
    return mesh;
}

/// Two sheets that touch: at a vertex, or along an edge that then has four half-edges.
TriangleMesh touching_sheets(bool share_edge) {
    TriangleMesh mesh{"touching", {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    mesh.positions.insert(mesh.positions.end(), {{0, 0, 3}, {2, 2, 4}, {-1, 0, 3}});
    if (share_edge) {
        mesh.triangles.insert(mesh.triangles.end(), {{0, 2, 4}, {2, 0, 5}});
    } else {
        mesh.triangles.insert(mesh.triangles.end(), {{0, 4, 5}, {0, 5, 6}});
    }
    return mesh;
}

/// Needles, points, lines and proper triangles on shared vertices.
TriangleMesh degenerate_strip() {
    TriangleMesh mesh{"degenerate", {}, {}};
    for (std::uint32_t i = 0; i < 6; ++i) {
        mesh.positions.push_back({float(i), 0, 0});
        mesh.positions.push_back({float(i), 1, 0});
    }
    for (std::uint32_t i = 0; i + 4 < 12; ++i) {
        mesh.triangles.push_back({i, i + 1, i + 2});
        mesh.triangles.push_back({i, i + 2, i + 4});
        mesh.triangles.push_back({i, i, i + 1});
        mesh.triangles.push_back({i, i, i});
    }
    return mesh;
}

std::vector<TriangleMesh> adversarial_meshes() {
    std::vector<TriangleMesh> meshes{{"one", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}},
                                     fan_on_one_edge(7),
                                     fan_on_one_edge(100),
                                     twice(closed_sphere(4, {0, 0, 0}, 1)),
                                     open_fan(6),
                                     touching_sheets(false),
                                     touching_sheets(true),
                                     degenerate_strip(),
                                     triangle_soup(30, 1)};
    for (std::uint32_t seed = 0; seed < 60; ++seed) meshes.push_back(chaotic_mesh(1000 + seed));
    for (std::uint32_t seed = 0; seed < 5; ++seed) meshes.push_back(jittered_sheet(9, seed));
    return meshes;
}

TEST(PairingProperty, EveryTriangleOnceAndEveryPairOnAnEdge) {
    for (const TriangleMesh& mesh : adversarial_meshes()) {
        for (const PairingMethod method : all_methods()) {
            SCOPED_TRACE(mesh.name + ", " + to_string(method));
            for (const EdgeIdentity identity : identities) {
                expect_valid(mesh, pair_triangles(mesh, method, identity), identity);
            }
        }
    }
}

TEST(PairingProperty, NoTwoFreeNeighboursAreLeftByGreedyScans) {
    // On edges of two half-edges: longer runs hide neighbours from the scan.
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        const TriangleMesh mesh = jittered_sheet(9, seed);
        const auto ids = identify(mesh, EdgeIdentity::Index);
        for (const char* name : {"edge_bbsa", "edge_bbsa_compressed", "sa_saving", "maximum"}) {
            const Partners partners = partners_of(
                pair_triangles(mesh, parse_pairing_method(name), EdgeIdentity::Index), mesh.triangles.size());
            for (std::uint32_t s = 0; s < partners.size(); ++s) {
                for (std::uint32_t t = 0; t < s; ++t) {
                    EXPECT_FALSE(!partners[s] && !partners[t] &&
                                 share_edge(mesh.triangles[s], mesh.triangles[t], ids))
                        << name << ' ' << s << ' ' << t;
                }
            }
        }
    }
}

TEST(PairingProperty, NoMethodHasMorePairsThanTheMaximum) {
    for (const TriangleMesh& mesh : adversarial_meshes()) {
        for (const EdgeIdentity identity : identities) {
            const auto most = pair_triangles(mesh, {PairingKind::Maximum, 0}, identity).pair_count;
            for (const PairingMethod method : all_methods()) {
                EXPECT_LE(pair_triangles(mesh, method, identity).pair_count, most)
                    << mesh.name << ", " << to_string(method);
            }
        }
    }
}

/// The same mesh with its vertices numbered anew at random.
TriangleMesh renumbered(const TriangleMesh& mesh, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> number(mesh.positions.size());
    for (std::uint32_t v = 0; v < number.size(); ++v) number[v] = v;
    for (std::uint32_t i = std::uint32_t(number.size()); i > 1; --i) {
        std::swap(number[i - 1], number[below(random, i)]);
    }
    TriangleMesh result = mesh;
    for (std::uint32_t v = 0; v < number.size(); ++v) result.positions[number[v]] = mesh.positions[v];
    for (Triangle& t : result.triangles) t = {number[t[0]], number[t[1]], number[t[2]]};
    return result;
}

/// 45,000 triangles and as many vertices: about a dozen blocks in every pass. Few heights and vertices in
/// random order, so that neighbouring triangles compete for edges of equal area from different blocks, and
/// equal positions meet from different blocks: the order within a pass shows in the result.
TriangleMesh mesh_of_many_blocks() {
    TriangleMesh mesh = split_sheet(150, 1);
    for (Vec3& p : mesh.positions) p.y = p.y < 0.5F ? 0.0F : 1.0F;
    return renumbered(mesh, 2);
}

TEST(PairingProperty, IsTheSameForEveryNumberOfThreads) {
    const TriangleMesh mesh = mesh_of_many_blocks();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
    const auto pair_on = [&mesh](int threads, PairingMethod method) {
        tbb::task_arena arena(threads);
        return arena.execute([&] { return pair_triangles(mesh, method, EdgeIdentity::Position); });
    };
    for (const PairingMethod method : all_methods()) {
        SCOPED_TRACE(to_string(method));
        const Pairing pairing = pair_on(1, method);
        for (const int threads : {2, 3, 4}) expect_equal(pair_on(threads, method), pairing);
    }
}

TEST(PairingProperty, DoesNotDependOnVertexNumbersWhereNoTwoEdgesTie) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const TriangleMesh mesh = jittered_sheet(12, seed), other = renumbered(mesh, seed);
        for (const PairingMethod method : all_methods()) {
            if (method.kind == PairingKind::Maximum || method.kind == PairingKind::SaSaving) continue;
            SCOPED_TRACE(to_string(method));
            EXPECT_EQ(partners_of(pair_triangles(mesh, method, EdgeIdentity::Index), mesh.triangles.size()),
                      partners_of(pair_triangles(other, method, EdgeIdentity::Index), mesh.triangles.size()));
        }
    }
}

TEST(PairingProperty, TheWindowsAndTheMaximumNeverDependOnVertexNumbers) {
    for (const TriangleMesh& mesh : adversarial_meshes()) {
        const TriangleMesh other = renumbered(mesh, 7);
        for (const char* name : {"none", "window:2", "window:9", "maximum"}) {
            const PairingMethod method = parse_pairing_method(name);
            EXPECT_EQ(pair_triangles(mesh, method, EdgeIdentity::Position).pair_count,
                      pair_triangles(other, method, EdgeIdentity::Position).pair_count)
                << mesh.name << ", " << name;
        }
    }
}

/// The rays of every workload, made once: their origins are hits.
std::vector<Workload> workloads(const TriangleMesh& mesh, const Camera& camera) {
    const MemoryImage image = image_of(mesh, {}, {PairingKind::None, 0});
    std::vector<Workload> result;
    for (const char* name : {"primary", "shadow", "ao", "diffuse", "random"}) {
        result.push_back(make_workload(parse_workload_kind(name), mesh, image, camera, {64, 64}, 1));
    }
    return result;
}

using Hits = std::vector<std::optional<Hit>>;

/// What each ray hits, to the bit; for any-hit rays, only whether it hits.
Hits hits_of(const TriangleMesh& mesh, const std::vector<Workload>& rays, PairingMethod method) {
    const MemoryImage image = image_of(mesh, {}, method);
    Hits result;
    for (const Workload& workload : rays) {
        for (const Ray& ray : workload.rays) {
            std::optional<Hit> hit = trace(image, ray, workload.ray_kind);
            if (hit && workload.ray_kind == RayKind::AnyHit) hit = Hit{};
            result.push_back(hit);
        }
    }
    return result;
}

void expect_the_same_hits(const TriangleMesh& mesh, const Camera& camera) {
    const std::vector<Workload> rays = workloads(mesh, camera);
    const Hits expected = hits_of(mesh, rays, {PairingKind::None, 0});
    for (const PairingMethod method : all_methods()) {
        EXPECT_TRUE(hits_of(mesh, rays, method) == expected) << mesh.name << ", " << to_string(method);
    }
}

TEST(PairingProperty, DoesNotChangeWhatARayHits) { expect_the_same_hits(builtin_scene(), builtin_camera()); }

TEST(PairingProperty, DoesNotChangeWhatARayHitsInAnAdversarialMesh) {
    for (const TriangleMesh& mesh : {fan_on_one_edge(100), open_fan(6), touching_sheets(false),
                                     touching_sheets(true), degenerate_strip(), triangle_soup(30, 1),
                                     jittered_sheet(9, 1), twice(closed_sphere(4, {0, 0, 0}, 1))}) {
        expect_the_same_hits(mesh, {{3, 4, 5}, {0.5F, 0.5F, 0}, {0, 1, 0}, 0.6F});
    }
}

}  // namespace
}  // namespace rtu::test
