#pragma once

#include <cstdint>

#include "model/matching.hpp"
#include "model/scratch_memory.hpp"
#include "model/weld.hpp"

namespace rtu::model {

/// window:N: in file order, each free triangle takes the first free one among the next N - 1 that has an edge
/// in common (two different vertices), on the lowest of its own sides that they share.
[[nodiscard]] Matching match_in_window(const IdentifiedMesh& mesh, std::uint32_t window,
                                       ScratchMemory& memory);

}  // namespace rtu::model
