#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "model/memory_image.hpp"
#include "study/fidelity/ray_population.hpp"
#include "study/run_options.hpp"
#include "study/workload_stream.hpp"
#include "traces/visit_chunk.hpp"

// What the points of one scene, one pairing and one tree share: for simulations the traversals of all rays,
// recorded once; for estimates, which traverse some of them, the rays themselves and the memory image.

namespace rtu::study {

enum class TreeContent : std::uint8_t { Traversals, Rays };

/// Loads the scene, pairs it, builds the tree, makes or reads the rays and leaves them or their traversals in
/// FOLDER/NAME.rtutrace, with rays the image in FOLDER/NAME.image, and what they are in FOLDER/NAME.json;
/// that is there only when all is complete, and then nothing is done. Throws Error as prepare_scene() and
/// TraceWriter do, and for rays that are wanted of a file of traversals.
void prepare_tree(const RunOptions& options, const SceneSource& source, TreeContent content,
                  const std::filesystem::path& folder, const std::string& name);

/// Host memory that a process needs which has the tree in memory, in bytes, without the machine.
[[nodiscard]] std::uint64_t tree_memory_bytes(const std::filesystem::path& folder, const std::string& name);

/// A prepared tree in memory.
class SweepTree {
  public:
    /// Throws Error for files that prepare_tree() did not write.
    SweepTree(const std::filesystem::path& folder, const std::string& name);

    /// With rays, the image. With traversals one of the right shape whose bytes are all zero: what their
    /// replay asks for.
    [[nodiscard]] const model::MemoryImage& image() const { return image_; }
    /// All traversals from the beginning, workload after workload; none of a tree with rays.
    [[nodiscard]] ChunkSource chunks() const;
    /// The rays of each workload; none of a tree with traversals.
    [[nodiscard]] const std::vector<std::unique_ptr<RayPopulation>>& populations() const {
        return populations_;
    }
    [[nodiscard]] double paired_percent() const { return paired_percent_; }

  private:
    model::MemoryImage image_;
    std::vector<std::shared_ptr<const traces::VisitChunk>> chunks_;
    std::vector<std::unique_ptr<RayPopulation>> populations_;
    double paired_percent_ = 0;
};

}  // namespace rtu::study
