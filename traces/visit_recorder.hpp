#pragma once

#include <vector>

#include "model/memory_image.hpp"
#include "model/traversal.hpp"
#include "traces/ray_chunk.hpp"
#include "traces/trace_header.hpp"
#include "traces/visit_chunk.hpp"

namespace rtu::traces {

/// The facts of an image that a traversal trace has in its header.
[[nodiscard]] ImageFacts image_facts(const model::MemoryImage& image);

/// Traverses `ray` and appends its steps to `chunk`. `scratch` only keeps its memory between rays.
void record_visits(VisitChunk& chunk, const model::MemoryImage& image, const model::Ray& ray,
                   model::Traversal& scratch);

/// The traversals of a chunk's rays, on all cores, as one or more chunks small enough to be written.
[[nodiscard]] std::vector<VisitChunk> record_visits(const RayChunk& rays, const model::MemoryImage& image);

}  // namespace rtu::traces
