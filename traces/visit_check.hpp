#pragma once

#include "traces/visit_chunk.hpp"

namespace rtu::traces {

/// Fills in where each ray's steps begin, and throws Error unless they are possible traversals that use the
/// chunk's visits and pair tests up. Afterwards a replay needs no check of its own.
void place_and_check(VisitChunk& chunk, const ImageFacts& image);

}  // namespace rtu::traces
