#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "model/memory_image.hpp"
#include "model/ray.hpp"
#include "sim/link_host.hpp"

namespace rtu::sim {

/// How rays and triangles come to the testers. In each mode every ray is tested against every pair.
enum class StreamMode : std::uint8_t {
    Direct,    ///< a ray and a pair go up for each test, and the host waits for the result
    Batched,   ///< a batch holds a ray and a pair for each of its tests
    Mixed,     ///< a block of rays stays in the machine while the pairs stream past it
    Resident,  ///< all pairs stay in the machine while the rays stream past them
};
/// What goes down.
enum class ReadBack : std::uint8_t {
    Tests,  ///< the result of every test
    Rays,   ///< the nearest hit of every ray, once it has met all pairs; Mixed and Resident only
    None,   ///< nothing
};

[[nodiscard]] std::span<const std::string_view> stream_mode_names();  ///< in the order of StreamMode
[[nodiscard]] std::span<const std::string_view> read_back_names();    ///< in the order of ReadBack
/// Throw Error, listing the known names, for anything else.
[[nodiscard]] StreamMode parse_stream_mode(std::string_view name);
[[nodiscard]] ReadBack parse_read_back(std::string_view name);
[[nodiscard]] std::string_view to_string(StreamMode mode);
[[nodiscard]] std::string_view to_string(ReadBack read_back);

/// Bytes of a pair on the link: its three or four vertices.
[[nodiscard]] inline std::uint32_t operand_bytes(const model::LeafPair& pair) {
    return pair.has_second() ? 48 : 36;
}
/// Bytes of the result of one triangle's test: t, u, v and whether it was hit.
inline constexpr std::uint32_t result_bytes = 16;

/// Rays, pairs, and how they are streamed.
struct StreamJob {
    std::span<const model::Ray> rays;        ///< at least 1
    std::span<const model::LeafPair> pairs;  ///< at least 1
    StreamMode mode = StreamMode::Batched;
    ReadBack read_back = ReadBack::Tests;
    std::uint64_t batch_tests = 1;   ///< pair tests of a batch, as near as the mode allows; Direct: 1
    std::uint64_t buffer_bytes = 0;  ///< of a batch's operands that lie close to the testers
};

/// One batch: the tests of every ray of one range with every pair of another, or a stretch of the list of all
/// tests, ray by ray.
struct StreamBatch {
    using Range = std::pair<std::uint64_t, std::uint64_t>;  ///< half open
    std::optional<Range> list;                              ///< of tests; else:
    Range rays, pairs;
    std::uint64_t test_count = 0;
    std::uint64_t up_bytes = 0;
    std::uint64_t down_bytes = 0;
    bool is_ray_far = false;   ///< the rays do not fit into the buffer: each test reads its ray from memory
    bool is_pair_far = false;  ///< nor do the pairs: each is read once, in a list by each of its tests
};

/// Divides a job into batches.
class StreamPlan final : public BatchSupply {
  public:
    /// Throws Error when a batch would be more than one transfer can carry, or the mode cannot read back like
    /// that. The rays and pairs must outlive it.
    explicit StreamPlan(const StreamJob& job);

    [[nodiscard]] std::uint64_t batch_count() const { return batch_count_; }
    /// Of all batches together.
    [[nodiscard]] std::uint64_t total_up_bytes() const;
    [[nodiscard]] std::uint64_t total_down_bytes() const;
    /// No batch has more pair tests.
    [[nodiscard]] std::uint64_t most_tests() const;
    /// No transfer has more bytes.
    [[nodiscard]] std::uint64_t most_bytes() const;
    [[nodiscard]] StreamBatch batch(std::uint64_t index) const;
    [[nodiscard]] std::optional<LinkBatch> next_batch() override;

  private:
    [[nodiscard]] StreamBatch list_batch(std::uint64_t index) const;
    [[nodiscard]] StreamBatch mixed_batch(std::uint64_t index) const;
    [[nodiscard]] StreamBatch resident_batch(std::uint64_t index) const;
    [[nodiscard]] std::uint64_t down_bytes(std::uint64_t triangle_tests, std::uint64_t finished_rays) const;

    StreamJob job_;
    std::vector<std::uint64_t> bytes_before_, triangles_before_;  // [pair]: in the pairs before it; one more
    std::uint64_t rays_per_block_ = 0;   // Mixed: that stay; Resident: that come together
    std::uint64_t pairs_per_step_ = 0;   // Mixed
    std::uint64_t steps_per_block_ = 1;  // Mixed
    std::uint64_t batch_count_ = 0;
    std::uint64_t next_ = 0;
};

}  // namespace rtu::sim
