#include "model/dual_graph.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "model/edge_table.hpp"

namespace rtu::model {
namespace {

using TrianglePairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

TrianglePairs neighbour_pairs(const IdentifiedMesh& mesh, std::uint32_t reach, ScratchMemory& memory) {
    TrianglePairs pairs;
    std::vector<std::uint32_t> fan;  // the triangles of the edge so far
    std::uint64_t fan_edge = 0;
    for_each_twin(mesh, memory, [&](std::uint32_t lower, std::uint32_t upper, HalfEdge a, HalfEdge b) {
        const std::uint64_t edge = std::uint64_t{lower} << 32 | upper;
        if (fan.empty() || edge != fan_edge) fan = {a.triangle()};
        fan_edge = edge;
        for (std::size_t i = fan.size() - std::min<std::size_t>(fan.size(), reach); i < fan.size(); ++i) {
            if (fan[i] != b.triangle()) pairs.emplace_back(fan[i], b.triangle());
        }
        fan.push_back(b.triangle());
    });
    return pairs;
}

}  // namespace

DualGraph::DualGraph(const IdentifiedMesh& mesh, std::uint32_t reach, ScratchMemory& memory)
    : begins_(mesh.triangles.size() + 1) {
    const TrianglePairs pairs = neighbour_pairs(mesh, reach, memory);
    for (const auto& [a, b] : pairs) {
        ++begins_[a];
        ++begins_[b];
    }
    std::uint64_t sum = 0;
    for (std::uint64_t& begin : begins_) begin = sum += begin;  // ends, until the nodes are put in place
    neighbours_.resize(sum);
    for (auto pair = pairs.rbegin(); pair != pairs.rend(); ++pair) {
        neighbours_[--begins_[pair->first]] = pair->second;
        neighbours_[--begins_[pair->second]] = pair->first;
    }
}

std::vector<std::uint32_t> connected_components(const DualGraph& graph) {
    constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> component(graph.node_count(), unknown), open;
    std::uint32_t count = 0;
    for (std::uint32_t start = 0; start < graph.node_count(); ++start) {
        if (component[start] != unknown) continue;
        component[start] = count;
        open = {start};
        while (!open.empty()) {
            const std::uint32_t node = open.back();
            open.pop_back();
            for (const std::uint32_t next : graph.neighbours(node)) {
                if (component[next] != unknown) continue;
                component[next] = count;
                open.push_back(next);
            }
        }
        ++count;
    }
    return component;
}

}  // namespace rtu::model
