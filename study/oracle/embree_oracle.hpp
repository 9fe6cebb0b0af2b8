#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/mesh.hpp"
#include "model/ray.hpp"

struct RTCSceneTy;
struct RTCDeviceTy;

namespace rtu::study {

/// Embree's default triangle test, or that of RTC_SCENE_FLAG_ROBUST.
enum class EmbreeMode : std::uint8_t { Default, Robust };

/// An independent opinion on every hit: Embree on the same triangles. Safe to ask from several threads.
class EmbreeOracle {
  public:
    /// `has_all_hits`: whether all_hits() may be asked. The filter that it needs would cost trace() time.
    explicit EmbreeOracle(const model::TriangleMesh& mesh, EmbreeMode mode = EmbreeMode::Robust,
                          bool has_all_hits = false);
    ~EmbreeOracle();
    EmbreeOracle(const EmbreeOracle&) = delete;
    EmbreeOracle& operator=(const EmbreeOracle&) = delete;

    /// The nearest hit, or for an any-hit ray some hit; nothing when the ray meets no triangle.
    /// Of an any-hit ray only whether there is a hit is meaningful.
    [[nodiscard]] std::optional<model::Hit> trace(const model::Ray& ray, model::RayKind kind) const;

    /// Every hit that Embree finds in the ray's interval, in no order: each is refused by a filter, so that
    /// the search goes on.
    [[nodiscard]] std::vector<model::Hit> all_hits(const model::Ray& ray) const;

  private:
    RTCDeviceTy* device_;
    RTCSceneTy* scene_;
};

}  // namespace rtu::study
