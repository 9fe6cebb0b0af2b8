#pragma once

// What must hold for every pairing of every mesh.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/pair_layout.hpp"
#include "model/pairing.hpp"
#include "tests/model/reference_pairing.hpp"

namespace rtu::test {

inline constexpr std::array identities{model::EdgeIdentity::Index, model::EdgeIdentity::Position};

/// One method of every kind.
inline std::vector<model::PairingMethod> all_methods() {
    std::vector<model::PairingMethod> methods;
    for (const char* name : {"none", "window:2", "window:9", "edge_bbsa", "edge_bbsa_compressed",
                             "sa_exchange", "sa_saving", "maximum"}) {
        methods.push_back(model::parse_pairing_method(name));
    }
    return methods;
}

/// Every triangle is stored exactly once, with its corners; pairs have an edge in common; counts are right.
inline void expect_valid(const model::TriangleMesh& mesh, const model::Pairing& pairing,
                         model::EdgeIdentity identity) {
    const std::vector<std::uint32_t> ids = identify(mesh, identity);
    const auto same = [&](const model::Triangle& a, const model::Triangle& b) {
        return ids[a[0]] == ids[b[0]] && ids[a[1]] == ids[b[1]] && ids[a[2]] == ids[b[2]];
    };
    std::vector<std::uint32_t> uses(mesh.triangles.size());
    std::optional<std::uint32_t> last;
    std::uint64_t pair_count = 0;
    for (const model::TrianglePair& pair : pairing.pairs) {
        const auto [first, second] = pair.primitive_ids;
        ASSERT_TRUE(first < mesh.triangles.size() && second < mesh.triangles.size());
        EXPECT_TRUE(!last || *last < first) << "not in the order of the first triangle";
        last = first;
        ++uses[first];
        EXPECT_EQ(model::file_corners(pair, 0), mesh.triangles[first]);
        EXPECT_TRUE(same(model::file_corners(pair, 1), mesh.triangles[second]));
        if (!pair.has_second) {
            EXPECT_EQ(first, second);
            EXPECT_EQ(pair.vertices[2], pair.vertices[3]);
            continue;
        }
        ++pair_count;
        ++uses[second];
        EXPECT_LT(first, second);
        EXPECT_NE(ids[pair.vertices[0]], ids[pair.vertices[2]]) << "the common edge is a point";
        EXPECT_TRUE(share_edge(mesh.triangles[first], mesh.triangles[second], ids));
    }
    EXPECT_EQ(uses, std::vector<std::uint32_t>(mesh.triangles.size(), 1));
    EXPECT_EQ(pairing.pair_count, pair_count);
    EXPECT_EQ(pairing.single_count, pairing.pairs.size() - pair_count);
}

inline void expect_equal(const model::Pairing& a, const model::Pairing& b) {
    ASSERT_EQ(a.pairs.size(), b.pairs.size());
    for (std::size_t i = 0; i < a.pairs.size(); ++i) {
        EXPECT_EQ(a.pairs[i].vertices, b.pairs[i].vertices);
        EXPECT_EQ(a.pairs[i].primitive_ids, b.pairs[i].primitive_ids);
        EXPECT_EQ(a.pairs[i].corner_order, b.pairs[i].corner_order);
    }
}

}  // namespace rtu::test
