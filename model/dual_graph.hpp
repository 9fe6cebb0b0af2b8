#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// Triangles as nodes, neighbours where two have an edge in common (two different vertices).
class DualGraph {
  public:
    /// Among the triangles of one edge, those at most `reach` apart in file order become neighbours.
    DualGraph(const IdentifiedMesh& mesh, std::uint32_t reach, ScratchMemory& memory);

    [[nodiscard]] std::uint32_t node_count() const { return std::uint32_t(begins_.size() - 1); }
    /// Without the node itself; one that is met on several edges comes several times.
    [[nodiscard]] std::span<const std::uint32_t> neighbours(std::uint32_t node) const {
        return std::span(neighbours_).subspan(begins_[node], begins_[node + 1] - begins_[node]);
    }

  private:
    std::vector<std::uint64_t> begins_;  ///< [node_count + 1]
    std::vector<std::uint32_t> neighbours_;
};

/// The connected component of every node, [node_count]; numbered by their lowest nodes.
[[nodiscard]] std::vector<std::uint32_t> connected_components(const DualGraph& graph);

}  // namespace rtu::model
