#pragma once

#include <cstdint>
#include <vector>

#include "model/memory_image.hpp"
#include "model/mesh.hpp"
#include "model/methods/method.hpp"
#include "study/oracle/embree_oracle.hpp"

namespace rtu::study {

/// A mesh in every form in which it is tested.
struct Surface {
    explicit Surface(model::TriangleMesh triangles);

    model::TriangleMesh mesh;
    std::vector<model::methods::Corners> corners;  ///< [triangle_count]
    std::vector<model::LeafPair> pairs;            ///< of edge_bbsa, every triangle once
    model::MemoryImage image;                      ///< of those pairs, 4 wide
    EmbreeOracle embree, embree_robust;
};

/// A hit of one of a surface's triangles.
struct SurfaceHit {
    std::uint32_t triangle = 0;
    model::methods::TestHit hit;
};

}  // namespace rtu::study
