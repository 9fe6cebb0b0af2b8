// The worked example of [AF], table by table.

#include <gtest/gtest.h>

#include <bit>

#include "model/edge_bbsa.hpp"
#include "model/pair_candidates.hpp"
#include "model/weld.hpp"
#include "tests/model/reference_pairing.hpp"

namespace rtu::test {
namespace {

using namespace rtu::model;

using Row = std::vector<std::uint32_t>;

/// Four rows of a half-edge table, as the paper prints them.
struct Table {
    Row areas, first_vertices, second_vertices, triangles;
    friend bool operator==(const Table&, const Table&) = default;
};

/// The paper's mesh: these corners give every area of its table with dx dy in the plane.
TriangleMesh worked_example() {
    return {"worked example",
            {{0, 0, 0}, {7, 0, 0}, {4, 5, 0}, {-5, 4, 0}, {-2, 10, 0}, {6, 10, 0}},
            {{0, 1, 2}, {1, 5, 2}, {5, 4, 2}, {4, 3, 2}, {3, 0, 2}}};
}

Table table_of(const std::vector<HalfEdgeRecord>& records) {
    Table table;
    for (const HalfEdgeRecord& r : records) {
        table.areas.push_back(std::uint32_t(r.area));
        table.first_vertices.push_back(r.lower);
        table.second_vertices.push_back(r.upper);
        table.triangles.push_back(r.triangle);
    }
    return table;
}

std::vector<HalfEdgeRecord> unsorted_records() {
    return half_edges(worked_example(), identify(worked_example(), EdgeIdentity::Index));
}

TEST(WorkedExample, HasThePapersHalfEdgeTable) {
    const Table printed{{0, 15, 20, 10, 10, 15, 0, 30, 10, 18, 9, 30, 20, 20, 9},
                        {0, 1, 0, 1, 2, 1, 4, 2, 2, 3, 2, 2, 0, 0, 2},
                        {1, 2, 2, 5, 5, 2, 5, 4, 5, 4, 3, 4, 3, 2, 3},
                        {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}};
    const Table table = table_of(unsorted_records());
    EXPECT_EQ(table.areas, printed.areas);
    EXPECT_EQ(table.first_vertices, printed.first_vertices);
    EXPECT_EQ(table.second_vertices, printed.second_vertices);
    EXPECT_EQ(table.triangles, printed.triangles);
}

const Table& printed_sorted_table() {
    static const Table table{{30, 30, 20, 20, 20, 18, 15, 15, 10, 10, 10, 9, 9, 0, 0},
                             {2, 2, 0, 0, 0, 3, 1, 1, 2, 2, 1, 2, 2, 4, 0},
                             {4, 4, 3, 2, 2, 4, 2, 2, 5, 5, 5, 3, 3, 5, 1},
                             {2, 3, 4, 0, 4, 3, 0, 1, 1, 2, 1, 3, 4, 2, 0}};
    return table;
}

TEST(WorkedExample, HasThePapersSortedTable) {
    // The paper sorts the vertices descending, too; triangles stay in order.
    std::vector<HalfEdgeRecord> records = unsorted_records();
    std::ranges::stable_sort(records, [](const HalfEdgeRecord& a, const HalfEdgeRecord& b) {
        return std::tie(a.area, a.lower, a.upper) > std::tie(b.area, b.lower, b.upper);
    });
    const Table table = table_of(records);
    EXPECT_EQ(table.areas, printed_sorted_table().areas);
    EXPECT_EQ(table.first_vertices, printed_sorted_table().first_vertices);
    EXPECT_EQ(table.second_vertices, printed_sorted_table().second_vertices);
    EXPECT_EQ(table.triangles, printed_sorted_table().triangles);
}

TEST(WorkedExample, DiffersFromThePapersTableInTheOrderOfEqualAreasOnly) {
    // Here vertices ascend: 0-3 changes places with the two of 0-2, 1-5 with the two of 2-5, 4-5 with 0-1.
    const std::vector<HalfEdgeRecord> records =
        half_edge_table(worked_example(), identify(worked_example(), EdgeIdentity::Index));
    const Table table = table_of(records);
    EXPECT_EQ(table.areas, printed_sorted_table().areas);
    EXPECT_EQ(table.first_vertices, (Row{2, 2, 0, 0, 0, 3, 1, 1, 1, 2, 2, 2, 2, 0, 4}));
    EXPECT_EQ(table.second_vertices, (Row{4, 4, 2, 2, 3, 4, 2, 2, 5, 5, 5, 3, 3, 1, 5}));
    EXPECT_EQ(table.triangles, (Row{2, 3, 0, 4, 4, 3, 0, 1, 1, 1, 2, 3, 4, 0, 2}));
}

/// One neighbour pair of equal keys of the paper's table and its "pairing status".
struct Status {
    std::uint32_t area;
    std::array<std::uint32_t, 2> triangles;
    bool is_accepted;
    friend bool operator==(const Status&, const Status&) = default;
};

TEST(WorkedExample, HasThePapersPairingStatus) {
    const TriangleMesh mesh = worked_example();
    ScratchMemory memory(1 << 16);
    const auto area_of = [&mesh](std::uint32_t lower, std::uint32_t upper, HalfEdge, HalfEdge) {
        return edge_box_area(mesh.positions[lower], mesh.positions[upper]);
    };
    const auto candidates = sorted_candidates(
        {mesh.triangles, mesh.positions, weld_positions(mesh.positions, memory)}, memory, area_of);
    Matching matching(5, memory);
    std::vector<Status> statuses;
    for (const PairCandidate& c : candidates) {
        const bool is_accepted = matching.try_pair(c.first, c.second);
        const auto area = std::bit_cast<float>(~c.rank & 0x7fff'ffffU);
        statuses.push_back({std::uint32_t(area), {c.first.triangle(), c.second.triangle()}, is_accepted});
    }
    const std::vector<Status> printed{
        {30, {2, 3}, true}, {20, {0, 4}, true}, {15, {0, 1}, false}, {10, {1, 2}, false}, {9, {3, 4}, false}};
    EXPECT_EQ(statuses, printed);

    const Pairing pairing = pair_triangles(mesh, {PairingKind::EdgeBbsa, 0}, EdgeIdentity::Index);
    EXPECT_EQ(partners_of(pairing, 5), (Partners{4, std::nullopt, 3, 2, 0}));
    EXPECT_DOUBLE_EQ(pairing.paired_percent(), 80.0);
}

}  // namespace
}  // namespace rtu::test
