#include "sim/stream_job.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "model/error.hpp"
#include "model/one_line.hpp"
#include "sim/link_message.hpp"

namespace rtu::sim {
namespace {

constexpr std::array<std::string_view, 4> mode_names{"direct", "batched", "mixed", "resident"};
constexpr std::array<std::string_view, 3> read_back_name_list{"tests", "rays", "none"};

template <class Names>
std::size_t index_of(const Names& names, std::string_view what, std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
        throw Error("{}: expected one of {}, got '{}'", what, fmt::join(names, ", "), model::one_line(name));
    return std::size_t(found - names.begin());
}

std::uint64_t divide_up(std::uint64_t value, std::uint64_t by) { return (value + by - 1) / by; }

// The sum over a stretch of the list of all tests, from the sums over the pairs before each.
std::uint64_t sum_of_list(const std::vector<std::uint64_t>& before, StreamBatch::Range list) {
    const std::uint64_t pair_count = before.size() - 1;
    const auto until = [&](std::uint64_t test) {
        return test / pair_count * before.back() + before[test % pair_count];
    };
    return until(list.second) - until(list.first);
}

}  // namespace

std::span<const std::string_view> stream_mode_names() { return mode_names; }
std::span<const std::string_view> read_back_names() { return read_back_name_list; }
StreamMode parse_stream_mode(std::string_view name) { return StreamMode(index_of(mode_names, "mode", name)); }
ReadBack parse_read_back(std::string_view name) {
    return ReadBack(index_of(read_back_name_list, "read-back", name));
}
std::string_view to_string(StreamMode mode) { return mode_names[std::size_t(mode)]; }
std::string_view to_string(ReadBack read_back) { return read_back_name_list[std::size_t(read_back)]; }

StreamPlan::StreamPlan(const StreamJob& job) : job_(job) {
    const bool is_list = job.mode == StreamMode::Direct || job.mode == StreamMode::Batched;
    if (is_list && job.read_back == ReadBack::Rays)
        throw Error("read-back rays: expected mode mixed or resident, got {}", to_string(job.mode));
    RTU_CHECK(!job.rays.empty() && !job.pairs.empty() && job.batch_tests > 0, "nothing to stream");
    bytes_before_ = triangles_before_ = {0};
    for (const model::LeafPair& pair : job.pairs) {
        bytes_before_.push_back(bytes_before_.back() + operand_bytes(pair));
        triangles_before_.push_back(triangles_before_.back() + (pair.has_second() ? 2 : 1));
    }
    const std::uint64_t ray_count = job.rays.size(), pair_count = job.pairs.size();
    if (job.mode == StreamMode::Direct) job_.batch_tests = 1;
    job_.batch_tests = std::min(job_.batch_tests, ray_count * pair_count);
    if (is_list) {
        batch_count_ = divide_up(ray_count * pair_count, job_.batch_tests);
    } else if (job.mode == StreamMode::Mixed) {
        rays_per_block_ = std::min(job_.batch_tests, ray_count);
        pairs_per_step_ = job_.batch_tests / rays_per_block_;
        steps_per_block_ = divide_up(pair_count, pairs_per_step_);
        batch_count_ = divide_up(ray_count, rays_per_block_) * steps_per_block_;
    } else {
        rays_per_block_ = std::max<std::uint64_t>(1, job_.batch_tests / pair_count);
        batch_count_ = divide_up(ray_count, rays_per_block_);
    }
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (most_bytes() > most) {
        throw Error("a batch of {} tests: expected at most {} bytes in a transfer, got up to {}",
                    job.batch_tests, most, most_bytes());
    }
}

std::uint64_t StreamPlan::total_up_bytes() const {
    const std::uint64_t all_ray_bytes = std::uint64_t(job_.rays.size()) * ray_bytes;
    switch (job_.mode) {
        case StreamMode::Direct:
        case StreamMode::Batched:
            return job_.pairs.size() * all_ray_bytes + job_.rays.size() * bytes_before_.back();
        case StreamMode::Mixed:
            return all_ray_bytes + batch_count_ / steps_per_block_ * bytes_before_.back();
        case StreamMode::Resident:
            break;
    }
    return all_ray_bytes + bytes_before_.back();
}

std::uint64_t StreamPlan::total_down_bytes() const {
    return down_bytes(job_.rays.size() * triangles_before_.back(), job_.rays.size());
}

std::uint64_t StreamPlan::most_tests() const {
    if (job_.mode == StreamMode::Mixed) return rays_per_block_ * pairs_per_step_;
    if (job_.mode == StreamMode::Resident) return rays_per_block_ * job_.pairs.size();
    return job_.batch_tests;
}

// As if every test had operands of its own, and every pair two triangles.
std::uint64_t StreamPlan::most_bytes() const {
    constexpr std::uint64_t most_test_bytes = ray_bytes + 48;
    static_assert(most_test_bytes >= 2 * result_bytes);
    return (most_tests() + job_.pairs.size()) * most_test_bytes;
}

std::uint64_t StreamPlan::down_bytes(std::uint64_t triangle_tests, std::uint64_t finished_rays) const {
    switch (job_.read_back) {
        case ReadBack::Tests:
            return triangle_tests * result_bytes;
        case ReadBack::Rays:
            return finished_rays * hit_bytes;
        case ReadBack::None:
            break;
    }
    return 0;
}

StreamBatch StreamPlan::batch(std::uint64_t index) const {
    RTU_CHECK(index < batch_count_, "batch {} of {}", index, batch_count_);
    switch (job_.mode) {
        case StreamMode::Direct:
        case StreamMode::Batched:
            return list_batch(index);
        case StreamMode::Mixed:
            return mixed_batch(index);
        case StreamMode::Resident:
            break;
    }
    return resident_batch(index);
}

StreamBatch StreamPlan::list_batch(std::uint64_t index) const {
    const std::uint64_t all = std::uint64_t(job_.rays.size()) * job_.pairs.size();
    const std::uint64_t first = index * job_.batch_tests;
    const StreamBatch::Range list{first, std::min(first + job_.batch_tests, all)};
    StreamBatch batch;
    batch.list = list;
    batch.test_count = list.second - list.first;
    batch.up_bytes = batch.test_count * ray_bytes + sum_of_list(bytes_before_, list);
    batch.down_bytes = down_bytes(sum_of_list(triangles_before_, list), 0);
    batch.is_ray_far = batch.is_pair_far = batch.up_bytes > job_.buffer_bytes;
    return batch;
}

StreamBatch StreamPlan::mixed_batch(std::uint64_t index) const {
    const std::uint64_t first_ray = index / steps_per_block_ * rays_per_block_;
    const std::uint64_t first_pair = index % steps_per_block_ * pairs_per_step_;
    StreamBatch batch;
    batch.rays = {first_ray, std::min<std::uint64_t>(first_ray + rays_per_block_, job_.rays.size())};
    batch.pairs = {first_pair, std::min<std::uint64_t>(first_pair + pairs_per_step_, job_.pairs.size())};
    const std::uint64_t rays = batch.rays.second - batch.rays.first;
    batch.test_count = rays * (batch.pairs.second - batch.pairs.first);
    batch.up_bytes = bytes_before_[batch.pairs.second] - bytes_before_[batch.pairs.first] +
                     (first_pair == 0 ? rays * ray_bytes : 0);
    const bool is_last_step = batch.pairs.second == job_.pairs.size();
    batch.down_bytes =
        down_bytes(rays * (triangles_before_[batch.pairs.second] - triangles_before_[batch.pairs.first]),
                   is_last_step ? rays : 0);
    batch.is_ray_far = rays * ray_bytes > job_.buffer_bytes;
    return batch;
}

StreamBatch StreamPlan::resident_batch(std::uint64_t index) const {
    const std::uint64_t first_ray = index * rays_per_block_;
    StreamBatch batch;
    batch.rays = {first_ray, std::min<std::uint64_t>(first_ray + rays_per_block_, job_.rays.size())};
    batch.pairs = {0, job_.pairs.size()};
    const std::uint64_t rays = batch.rays.second - batch.rays.first;
    batch.test_count = rays * job_.pairs.size();
    batch.up_bytes = rays * ray_bytes + (index == 0 ? bytes_before_.back() : 0);
    batch.down_bytes = down_bytes(rays * triangles_before_.back(), rays);
    batch.is_ray_far = rays * ray_bytes > job_.buffer_bytes;
    batch.is_pair_far = rays * ray_bytes + bytes_before_.back() > job_.buffer_bytes;
    return batch;
}

std::optional<LinkBatch> StreamPlan::next_batch() {
    if (next_ == batch_count_) return std::nullopt;
    const StreamBatch next = batch(next_++);
    return LinkBatch{1, next.up_bytes, next.down_bytes};
}

}  // namespace rtu::sim
