#include <gtest/gtest.h>

#include "model/pairing_prescan.hpp"
#include "tests/model/pairing_checks.hpp"
#include "tests/model/pairing_meshes.hpp"

namespace rtu::test {
namespace {

using namespace rtu::model;

/// `count` quads of two triangles each, in file order, no two quads joined.
TriangleMesh quads(std::uint32_t count) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto x = float(3 * i);
        for (const Vec3 p : {Vec3{x, 0, 0}, Vec3{x + 1, 0, 0}, Vec3{x + 1, 1, 0}, Vec3{x, 1, 0}}) {
            mesh.positions.push_back(p);
        }
        mesh.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
        mesh.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
    }
    return mesh;
}

TEST(PairingPrescan, LeavesQuadsAlone) {
    const PairingPrescan scan = prescan_pairing(quads(100), EdgeIdentity::Index);
    EXPECT_TRUE(scan.is_well_paired);
    EXPECT_EQ(scan.scanned_triangles, 200U);
    EXPECT_EQ(scan.lone_triangles, 0U);
}

TEST(PairingPrescan, ToleratesFiveLoneTrianglesInAHundredThousand) {
    TriangleMesh mesh = quads(50'000);
    for (std::uint32_t i = 0; i < 5; ++i) mesh.triangles.push_back({0, 5, 9});
    // Two of them have an edge in common with the next; the fifth is alone. Break them up:
    for (std::uint32_t i = 0; i < 5; ++i) mesh.triangles[100'000 + i] = {16 * i, 16 * i + 5, 16 * i + 10};
    EXPECT_TRUE(prescan_pairing(mesh, EdgeIdentity::Index).is_well_paired);
    mesh.triangles.push_back({100, 105, 110});
    EXPECT_FALSE(prescan_pairing(mesh, EdgeIdentity::Index).is_well_paired);
}

TEST(PairingPrescan, StopsWhenTheAnswerIsNo) {
    const PairingPrescan scan = prescan_pairing(split_sheet(50, 1), EdgeIdentity::Position);
    EXPECT_FALSE(scan.is_well_paired);
    EXPECT_EQ(scan.lone_triangles, 1U);
    EXPECT_LT(scan.scanned_triangles, 10U);
}

TEST(PairingPrescan, AgreesWithWindow2) {
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        const TriangleMesh mesh = chaotic_mesh(seed);
        for (const EdgeIdentity identity : identities) {
            const Pairing pairing = pair_triangles(mesh, {PairingKind::Window, 2}, identity);
            const bool is_expected =
                mesh.triangles.empty() || pairing.paired_percent() >= well_paired_percent;
            EXPECT_EQ(prescan_pairing(mesh, identity).is_well_paired, is_expected);
        }
    }
}

}  // namespace
}  // namespace rtu::test
