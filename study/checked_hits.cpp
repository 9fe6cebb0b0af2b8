#include "study/checked_hits.hpp"

#include "study/cpu_time.hpp"

namespace rtu::study {
namespace {

constexpr std::size_t rays_of_batch = 1 << 16;  // enough to keep all cores busy

}  // namespace

void CheckedHits::add_hit(const std::optional<model::Hit>& hit) {
    if (hit) ++hit_count_;
    if (checker_ == nullptr) return;
    batch_.rays.push_back(rays_.front());
    rays_.pop_front();
    hits_.push_back(hit);
    if (hits_.size() == rays_of_batch) check_batch();
}

void CheckedHits::check_batch() {
    const double start = study::cpu_seconds();
    counts_ += checker_->check(batch_, hits_);
    cpu_seconds_ += study::cpu_seconds() - start;
    batch_.rays.clear();
    hits_.clear();
}

model::TraversalCounts CheckedHits::finish() {
    if (!hits_.empty()) check_batch();
    return counts_;
}

}  // namespace rtu::study
