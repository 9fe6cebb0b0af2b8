#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "study/stream/stream_study.hpp"

namespace rtu::study {

/// A sample of a scene's rays and pairs.
struct StreamInput {
    SceneFacts scene;
    std::string input_hash;
    PairingFacts pairing;
    std::vector<model::Ray> rays;
    std::vector<model::LeafPair> pairs;
};

/// Reads the scene, pairs it, makes the workload's rays and samples both. Throws Error as load_scene() does,
/// and for a workload without rays.
[[nodiscard]] StreamInput make_stream_input(const StreamOptions& options);

/// Runs streams of one input and remembers what they have in common. The input must outlive it.
class StreamRunner {
  public:
    explicit StreamRunner(const StreamInput& input) : input_(input) {}

    [[nodiscard]] const StreamInput& input() const { return input_; }
    [[nodiscard]] sim::StreamJob job(const LinkedMachine& machine, sim::StreamMode mode,
                                     sim::ReadBack read_back, std::uint64_t batch_tests) const;
    /// One stream, and the same without the link. Throws std::logic_error when the hits are not those of the
    /// streams before.
    [[nodiscard]] StreamRow run(const LinkedMachine& machine, sim::StreamMode mode, sim::ReadBack read_back,
                                std::uint64_t batch_tests);
    /// Rays with a hit; 0 before the first stream.
    [[nodiscard]] std::uint64_t hit_count() const;

  private:
    [[nodiscard]] std::uint64_t alone_cycles(const LinkedMachine& machine, const sim::StreamJob& job);

    const StreamInput& input_;
    std::optional<std::vector<std::optional<model::Hit>>> hits_;
    using AloneKey = std::tuple<sim::StreamMode, sim::ReadBack, std::uint64_t, std::uint32_t, std::uint32_t,
                                std::uint64_t>;
    std::map<AloneKey, std::uint64_t> alone_;
};

}  // namespace rtu::study
