#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "model/methods/method.hpp"

// Every ray against every triangle: the loops in which the methods' speed is measured, for each method, form
// and SIMD width. Several instruction sets are compiled in; the processor's best is used.

namespace rtu::model::methods {

/// What is tested at once.
enum class Form : std::uint8_t {
    Single,     ///< one ray, one triangle
    Rays,       ///< W rays, one triangle: a packet
    Triangles,  ///< one ray, W triangles in structure of arrays: a wide leaf
    Pairs,      ///< one ray, W pairs of triangles (a, b, c), (a, c, d) that share a-c
};

/// "single", "rays", "triangles", "pairs".
[[nodiscard]] std::string_view name_of(Form form);

/// Triangles in the layout that a kernel reads. Its capacity is kept from call to call.
struct PreparedTriangles {
    hwy::AlignedFreeUniquePtr<float[]> values;
    std::size_t capacity = 0;          ///< of values
    std::vector<std::uint8_t> axes;    ///< where single triangles have one
    std::size_t count = 0;             ///< triangles, or pairs
    float* reserve(std::size_t size);  ///< values, with room for `size` of them
};

/// What a ray meets among all triangles.
struct RayResult {
    TestHit nearest;              ///< the least t; of equals, the first triangle
    std::uint32_t triangle = 0;   ///< its index
    std::uint32_t hit_count = 0;  ///< tests that hit; 0: all else is 0
    friend bool operator==(const RayResult&, const RayResult&) = default;
};

/// A method in one form and width.
struct Kernel {
    MethodInfo method;
    Form form;
    std::uint32_t width;  ///< W; 1 for scalar code
    /// The method's precomputation. Pairs: triangles 2i and 2i + 1 are (a, b, c) and (a, c, d). At most 2^24.
    void (*store)(std::span<const Corners> triangles, PreparedTriangles& to);
    /// Tests each ray against all triangles, t in the ray's own interval. `shrinks`: a hit lowers t_max, so
    /// that later triangles are rejected early; else every test is on its own and hit_count counts all hits.
    void (*trace)(const PreparedTriangles& triangles, std::span<const Ray> rays, bool shrinks,
                  std::span<RayResult> results);
};

/// All kernels that this processor runs, method by method, narrow ones first.
[[nodiscard]] const std::vector<Kernel>& all_kernels();

/// The instruction set that they use: "AVX3", "AVX2", "SSE2", "NEON" ...
[[nodiscard]] std::string_view instruction_set();

}  // namespace rtu::model::methods
