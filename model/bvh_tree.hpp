#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>
#include <span>

#include "model/bvh.hpp"
#include "model/mesh.hpp"
#include "model/pairing.hpp"

namespace rtu::model {

/// A pair in a leaf, and the box of the part of it that the leaf is for: all of it, without spatial splits.
struct BuildReference {
    Aabb box;
    std::uint32_t pair = 0;  ///< index into Pairing::pairs
};

/// A node or leaf of Embree's tree, in memory that belongs to the RTCBVH: this header, then `count` children
/// or references.
struct BuildRecord {
    bool is_leaf;
    std::uint32_t count;

    [[nodiscard]] std::span<BuildRecord*> children() {
        return {reinterpret_cast<BuildRecord**>(this + 1), count};
    }
    [[nodiscard]] std::span<BuildReference> references() {
        return {reinterpret_cast<BuildReference*>(this + 1), count};
    }
};
static_assert(sizeof(BuildRecord) % alignof(BuildRecord*) == 0 &&
              sizeof(BuildRecord) % alignof(BuildReference) == 0);

/// Embree's tree over the pairs' boxes, and the memory it lies in. Built on one thread.
class EmbreeTree {
  public:
    /// `mesh` and `pairing` are not kept.
    EmbreeTree(const TriangleMesh& mesh, const Pairing& pairing, BvhOptions options);
    [[nodiscard]] BuildRecord& root() const { return *root_; }

  private:
    struct ReleaseDevice {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    };
    struct ReleaseBvh {
        void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
    };

    std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
    std::unique_ptr<RTCBVHTy, ReleaseBvh> bvh_;
    BuildRecord* root_ = nullptr;
};

}  // namespace rtu::model
