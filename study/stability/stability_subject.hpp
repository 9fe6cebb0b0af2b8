#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/stability/stability_surface.hpp"

namespace rtu::study {

/// Something that claims to know what a ray hits: a method of model/methods, the machine's pair test, the
/// machine's whole traversal, or Embree.
class Subject {
  public:
    Subject(std::string name, std::string contraction)
        : name_(std::move(name)), contraction_(std::move(contraction)) {}
    virtual ~Subject() = default;
    Subject(const Subject&) = delete;
    Subject& operator=(const Subject&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    /// "off", "fast", or "-" for code that is not the project's.
    [[nodiscard]] const std::string& contraction() const { return contraction_; }

    /// Whether it can be asked for a triangle alone.
    [[nodiscard]] virtual bool tests_triangles() const { return true; }
    /// Its answer for one triangle, both sides counting: a one-sided method is asked for both windings.
    [[nodiscard]] virtual std::optional<model::methods::TestHit> test(
        const model::Ray& ray, const model::methods::Corners& corners) const = 0;
    /// All hits of a surface in the ray's interval, in no order, each triangle once.
    [[nodiscard]] virtual std::vector<SurfaceHit> all_hits(const model::Ray& ray,
                                                           const Surface& surface) const = 0;
    /// Whether it needs all of a surface's triangles one by one, which large surfaces do not allow.
    [[nodiscard]] virtual bool is_exhaustive() const { return true; }

  private:
    std::string name_, contraction_;
};

/// The names of all subjects, in the order of the tables: those of model/methods, then rtu, rtu_traversal,
/// embree and embree_robust.
[[nodiscard]] std::vector<std::string> subject_names();

/// The subjects of these names, or all for none: a method in both modes of contraction, where the processor
/// can fuse. Throws Error, with the known ones, for a name that is not there or is given twice.
[[nodiscard]] std::vector<std::unique_ptr<Subject>> make_subjects(std::span<const std::string> names);

}  // namespace rtu::study
