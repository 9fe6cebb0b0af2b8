#pragma once

#include <cstdint>
#include <vector>

#include "model/mailbox.hpp"
#include "model/memory_image.hpp"
#include "model/ray.hpp"

namespace rtu::model {

/// Whether a triangle may be reported to a ray more than once. An API may forbid it: a flag of a geometry in
/// Vulkan and DXR asks for one call of the any-hit shader a triangle at most.
enum class DuplicateRule : std::uint8_t { Allowed, Forbidden };

/// What a ray that no hit ends is told.
struct AllHits {
    std::vector<Hit> hits;         ///< in the order of the tests; not sorted by t
    std::uint64_t duplicates = 0;  ///< of them, triangles that had been reported before: 0 where forbidden
    std::uint64_t pair_tests = 0;
};

/// All triangles that the ray pierces within (t_min, t_max), as an any-hit shader that accepts none is
/// called: the case in which spatial splits can be seen, for a ray that ends at its first hit is told of one
/// triangle, and a closest hit is one. A mailbox of few entries makes duplicates rarer and cannot rule them
/// out, so `Forbidden` compares with all that was reported to the ray, whatever the mailbox.
[[nodiscard]] AllHits find_all_hits(const MemoryImage& image, const Ray& ray, MailboxOptions mailbox,
                                    DuplicateRule rule);

}  // namespace rtu::model
