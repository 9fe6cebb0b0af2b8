#include "model/maximum_matching.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>
#include <cstdint>
#include <span>
#include <vector>

#include "model/dual_graph.hpp"
#include "model/edge_bbsa.hpp"
#include "model/edge_ring.hpp"
#include "model/error.hpp"

namespace rtu::model {
namespace {

/// Who is matched with whom: [node_count], a free node with itself.
using Mates = std::vector<std::uint32_t>;

/// Augments along breadth-first alternating paths from free nodes. Odd cycles are not contracted, so a path
/// may be missed; one that is found is simple, as every node is met once. What a search without success has
/// met is not searched again.
class AlternatingSearch {
  public:
    AlternatingSearch(const DualGraph& graph, Mates& mates)
        : graph_(graph), mates_(mates), parents_(graph.node_count()), is_met_(graph.node_count()) {}

    bool augment_from(std::uint32_t root) {
        queue_ = {root};
        met_.clear();
        for (std::size_t i = 0; i < queue_.size(); ++i) {
            for (const std::uint32_t node : graph_.neighbours(queue_[i])) {
                if (is_met_[node] || node == root) continue;
                parents_[node] = queue_[i];
                if (mates_[node] == node) {
                    flip(node, root);
                    for (const std::uint32_t met : met_) is_met_[met] = false;
                    return true;
                }
                queue_.push_back(mates_[node]);
                for (const std::uint32_t met : {node, mates_[node]}) {
                    is_met_[met] = true;
                    met_.push_back(met);
                }
            }
        }
        return false;
    }

  private:
    /// Matches every second edge of the path from the root to the free node `end`.
    void flip(std::uint32_t end, std::uint32_t root) {
        for (std::uint32_t node = end;;) {
            const std::uint32_t parent = parents_[node], next = mates_[parent];
            mates_[node] = parent;
            mates_[parent] = node;
            if (parent == root) return;
            node = next;
        }
    }

    const DualGraph& graph_;
    Mates& mates_;
    std::vector<std::uint32_t> parents_;  ///< the node before a met one on the path from the root
    std::vector<bool> is_met_;
    std::vector<std::uint32_t> met_, queue_;
};

/// Makes the matching of one component's nodes a maximum. `local` is scratch: [node_count].
void complete(const DualGraph& graph, std::span<const std::uint32_t> nodes, Mates& mates,
              std::vector<std::uint32_t>& local) {
    using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
    using Node = boost::graph_traits<Graph>::vertex_descriptor;
    for (std::uint32_t i = 0; i < nodes.size(); ++i) local[nodes[i]] = i;
    Graph part(nodes.size());
    std::vector<Node> part_mates(nodes.size());
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        const std::uint32_t mate = mates[nodes[i]];
        part_mates[i] = mate == nodes[i] ? boost::graph_traits<Graph>::null_vertex() : local[mate];
        for (const std::uint32_t next : graph.neighbours(nodes[i])) {
            if (next > nodes[i]) boost::add_edge(i, local[next], part);
        }
    }
    const auto index = boost::get(boost::vertex_index, part);
    boost::edmonds_augmenting_path_finder<Graph, Node*, decltype(index)> finder(part, part_mates.data(),
                                                                                index);
    while (finder.augment_matching()) {
    }
    finder.get_current_matching(part_mates.data());
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        const bool is_free = part_mates[i] == boost::graph_traits<Graph>::null_vertex();
        mates[nodes[i]] = is_free ? nodes[i] : nodes[part_mates[i]];
    }
}

/// Completes the components that have two free nodes or more; one is left over where the number is odd.
void complete_components(const DualGraph& graph, Mates& mates) {
    const std::vector<std::uint32_t> component = connected_components(graph);
    std::vector<std::uint32_t> free_counts(graph.node_count());
    for (std::uint32_t node = 0; node < graph.node_count(); ++node) {
        if (mates[node] == node) ++free_counts[component[node]];
    }
    std::vector<std::vector<std::uint32_t>> nodes(graph.node_count());
    for (std::uint32_t node = 0; node < graph.node_count(); ++node) {
        if (free_counts[component[node]] >= 2) nodes[component[node]].push_back(node);
    }
    std::vector<std::uint32_t> local(graph.node_count());
    for (const auto& part : nodes) {
        if (!part.empty()) complete(graph, part, mates, local);
    }
}

Mates mates_of(const Matching& matching) {
    Mates mates(matching.triangle_count());
    for (std::uint32_t t = 0; t < mates.size(); ++t) mates[t] = matching.partner(t).triangle();
    return mates;
}

}  // namespace

Matching match_maximum(const IdentifiedMesh& mesh, ScratchMemory& memory) {
    const auto triangle_count = std::uint32_t(mesh.triangles.size());
    const DualGraph graph(mesh, max_edge_reach, memory);
    Mates mates;
    {
        const ScratchMemory::Scope scope(memory);
        mates = mates_of(match_by_edge_area(mesh, EdgeRings(mesh, memory), memory));
    }
    AlternatingSearch search(graph, mates);
    for (std::uint32_t t = 0; t < triangle_count; ++t) {
        if (mates[t] == t) search.augment_from(t);
    }
    complete_components(graph, mates);

    Matching matching(triangle_count, memory);
    for (std::uint32_t t = 0; t < triangle_count; ++t) {
        if (mates[t] <= t) continue;
        const auto edge = common_edge(mesh, t, mates[t]);
        RTU_CHECK(edge.has_value(), "triangles {} and {} have no common edge", t, mates[t]);
        matching.try_pair(edge->first, edge->second);
    }
    return matching;
}

}  // namespace rtu::model
