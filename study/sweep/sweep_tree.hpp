#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "model/memory_image.hpp"
#include "study/run_options.hpp"
#include "study/workload_stream.hpp"
#include "traces/visit_chunk.hpp"

// What the points of one scene, one pairing and one tree share: the traversals of all rays, recorded once.

namespace rtu::study {

/// Loads the scene, pairs it, builds the tree, makes or reads the rays and records their traversals in two
/// files, FOLDER/NAME.rtutrace and FOLDER/NAME.json; the second is there only when all is complete, and then
/// nothing is done. Throws Error as prepare_scene() and TraceWriter do.
void prepare_tree(const RunOptions& options, const SceneSource& source, const std::filesystem::path& folder,
                  const std::string& name);

/// Host memory that a process needs which has the tree in memory, in bytes, without the machine.
[[nodiscard]] std::uint64_t tree_memory_bytes(const std::filesystem::path& folder, const std::string& name);

/// A prepared tree in memory.
class SweepTree {
  public:
    /// Throws Error for files that prepare_tree() did not write.
    SweepTree(const std::filesystem::path& folder, const std::string& name);

    /// An image of the right shape whose bytes are all zero: what a replay of recorded rays asks for.
    [[nodiscard]] const model::MemoryImage& image() const { return image_; }
    /// All rays from the beginning, workload after workload.
    [[nodiscard]] ChunkSource chunks() const;
    [[nodiscard]] double paired_percent() const { return paired_percent_; }

  private:
    model::MemoryImage image_;
    std::vector<std::shared_ptr<const traces::VisitChunk>> chunks_;
    double paired_percent_ = 0;
};

}  // namespace rtu::study
