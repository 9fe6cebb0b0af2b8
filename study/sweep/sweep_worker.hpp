#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/sweep/sweep_journal.hpp"
#include "study/sweep/sweep_plan.hpp"
#include "study/sweep/sweep_tree.hpp"

// The process that simulates points, and what it must know of them.

namespace rtu::study {

/// What a worker must know of each point of a plan, as text: a line of JSON a point, in the order of the
/// plan.
[[nodiscard]] std::string point_list(const SweepPlan& plan);

/// Simulates points of a list, one after another.
class SweepWorker {
  public:
    /// `list` is a file of point_list(), in the folder where the trees are prepared. Makes the journal.
    SweepWorker(const std::filesystem::path& list, const std::filesystem::path& journal);

    /// Simulates a point and leaves what it gave in the journal, before it returns; an error of the
    /// simulation too. False for that: the process should not be trusted with another. Throws Error for an
    /// index behind the list, for a list, tree or journal that cannot be read or written.
    [[nodiscard]] bool run(std::size_t index);
    /// The id of a point.
    [[nodiscard]] std::string id(std::size_t index) const;

  private:
    [[nodiscard]] const SweepTree& tree(const std::string& name);

    std::filesystem::path folder_;
    std::vector<std::string> points_;
    JournalWriter journal_;
    std::optional<SweepTree> tree_;
    std::string tree_name_;
};

}  // namespace rtu::study
