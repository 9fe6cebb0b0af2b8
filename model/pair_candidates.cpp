#include "model/pair_candidates.hpp"

namespace rtu::model {

Matching match_greedily(std::span<const PairCandidate> candidates, std::uint32_t triangle_count,
                        ScratchMemory& memory) {
    Matching matching(triangle_count, memory);
    for (const PairCandidate& candidate : candidates) matching.try_pair(candidate.first, candidate.second);
    return matching;
}

}  // namespace rtu::model
