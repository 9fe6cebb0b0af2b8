#pragma once

#include <memory>
#include <optional>

#include "model/mesh.hpp"
#include "model/ray.hpp"

struct RTCSceneTy;
struct RTCDeviceTy;

namespace rtu::study {

/// An independent opinion on every hit: Embree in robust mode on the same triangles. Safe to ask from several
/// threads.
class EmbreeOracle {
  public:
    explicit EmbreeOracle(const model::TriangleMesh& mesh);
    ~EmbreeOracle();
    EmbreeOracle(const EmbreeOracle&) = delete;
    EmbreeOracle& operator=(const EmbreeOracle&) = delete;

    /// The nearest hit, or for an any-hit ray some hit; nothing when the ray meets no triangle.
    /// Of an any-hit ray only whether there is a hit is meaningful.
    [[nodiscard]] std::optional<model::Hit> trace(const model::Ray& ray, model::RayKind kind) const;

  private:
    RTCDeviceTy* device_;
    RTCSceneTy* scene_;
};

}  // namespace rtu::study
