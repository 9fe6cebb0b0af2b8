#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "study/stream/stream_input.hpp"
#include "study/stream/stream_study.hpp"

namespace rtu::study {

/// The options for what published_streams() needs: lone triangles, and 2^20 tests where the scene has enough.
[[nodiscard]] StreamOptions published_options(StreamOptions options);

/// The setups of P. C. D. Robert and D. Schweri, "GPU-Based Ray-Triangle Intersection Testing" [RS], with the
/// rates that they published, on `machine`, which should be published_options().machines[0]: direct passing,
/// batches of n x n tests by textures, and mixed mode. `progress` may be empty.
[[nodiscard]] std::vector<PublishedStream> published_streams(
    const StreamInput& input, const LinkedMachine& machine,
    const std::function<void(std::string_view)>& progress = {});

/// The sizes of textures that they measured, in tests: squares of powers of two.
[[nodiscard]] std::vector<std::uint64_t> published_texture_sizes();

}  // namespace rtu::study
