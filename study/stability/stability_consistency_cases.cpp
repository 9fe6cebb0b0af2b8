#include <fmt/format.h>

#include <array>
#include <utility>

#include "study/stability/stability_cases.hpp"
#include "study/stability/stability_metamorphic.hpp"
#include "study/stability/stability_probes.hpp"

namespace rtu::study {
namespace {

// Rays at all parts of a triangle in turn.
DrawProbe everywhere(float offset) {
    return [=](model::RandomStream& random) {
        constexpr std::array<Target, 4> targets{Target::Inside, Target::Edge, Target::Vertex, Target::Around};
        return probe_of_size(1, 3, offset, targets[draw_below(random, 4)])(random);
    };
}

StabilityCase reintersect() {
    StabilityCase result{15,
                         "reintersect",
                         "secondary rays at the surface they leave",
                         "no hit of that surface where it is left by an error bound",
                         {}};
    const std::array<std::pair<const char*, Start>, 3> starts{
        {{"o + t d", Start::PointOfT},
         {"from u, v", Start::PointOfWeights},
         {"from u, v, moved off", Start::MovedOffSurface}}};
    const std::array<std::pair<const char*, DrawProbe>, 3> shapes{
        {{"unit", probe_of_size(1, 3, 0, Target::Inside)},
         {"offset 1e3", probe_of_size(1, 3, 1e3F, Target::Inside)},
         {"10^-8 to 10^8", probe_of_mixed_scales(8)}}};
    for (const auto& [start_name, start] : starts) {
        for (const auto& [shape, draw] : shapes) {
            result.settings.push_back(
                {fmt::format("{}, {}", start_name, shape), "random",
                 [draw = draw, start = start] { return self_hit_experiment(draw, start); },
                 start != Start::MovedOffSurface});
        }
    }
    return result;
}

StabilityCase invariance() {
    StabilityCase result{
        16, "invariance", "corner order, winding, axes, length of the direction", "the same decision", {}};
    const std::array<std::pair<const char*, Change>, 4> changes{
        {{"corners rotated", Change::Rotation},
         {"corners exchanged", Change::Winding},
         {"48 axis symmetries", Change::Axes},
         {"direction times 2^k", Change::PowerOfTwo}}};
    for (const auto& [name, change] : changes) {
        for (const auto& [place, offset] : {std::pair("", 0.0F), {", offset 1e3", 1e3F}}) {
            result.settings.push_back(
                {fmt::format("{}{}", name, place), "all", [change = change, offset = offset] {
                     return variant_experiment(everywhere(offset), change);
                 }});
        }
    }
    return result;
}

StabilityCase order() {
    StabilityCase result{17,
                         "order",
                         "two surfaces at nearly one distance",
                         "equal t of coplanar copies, the nearer one nearer",
                         {}};
    for (const float ulps : {0.0F, 1.0F, 4.0F, 16.0F, 64.0F, 256.0F}) {
        const std::string name = ulps == 0 ? "a copy, corners rotated" : fmt::format("{} ulps apart", ulps);
        result.settings.push_back(
            {name, "inside", [=] { return order_experiment(probe_of_size(1, 3, 0, Target::Inside), ulps); }});
    }
    return result;
}

StabilityCase early_out() {
    StabilityCase result{19,
                         "early_out",
                         "shrinking intervals, and boxes",
                         "a hit lasts while t < t_max, and its box is met",
                         {}};
    result.settings.push_back(
        {"t_max shrinks", "all", [] { return variant_experiment(everywhere(0), Change::Shrinking); }});
    const std::array<std::pair<const char*, Slab>, 2> slabs{
        {{"machine's slab test", Slab::Machine}, {"textbook slab test", Slab::Textbook}}};
    const std::array<std::pair<const char*, DrawProbe>, 3> shapes{
        {{"", everywhere(0)},
         {", offset 1e3", everywhere(1e3F)},
         {", needles", probe_of_sliver(1e-4F, Target::Edge)}}};
    for (const auto& [slab_name, slab] : slabs) {
        for (const auto& [shape, draw] : shapes) {
            result.settings.push_back({fmt::format("{}{}", slab_name, shape), "all",
                                       [draw = draw, slab = slab] { return box_experiment(draw, slab); },
                                       slab == Slab::Textbook});
        }
    }
    return result;
}

StabilityCase mailbox() {
    return {18,
            "mailbox",
            "a triangle in several leaves",
            "not applicable: it is asked of a mailbox, not of a method",
            {}};
}

std::string compiler() {
#if defined(__clang__)
    return fmt::format("clang {}.{}", __clang_major__, __clang_minor__);
#elif defined(__GNUC__)
    return fmt::format("g++ {}.{}", __GNUC__, __GNUC_MINOR__);
#else
    return "another compiler";
#endif
}

StabilityCase compilers() {
    StabilityCase result{21,
                         "compiler",
                         "fused multiply-adds of the compiler's choosing",
                         "the decision of the code without them",
                         {}};
    for (const auto& [place, offset] : {std::pair("", 0.0F), {", offset 1e3", 1e3F}}) {
        result.settings.push_back({fmt::format("{}{}", compiler(), place), "all", [offset = offset] {
                                       return variant_experiment(everywhere(offset), Change::Contraction);
                                   }});
    }
    return result;
}

}  // namespace

std::vector<StabilityCase> consistency_cases() {
    return {reintersect(), invariance(), order(), mailbox(), early_out(), compilers()};
}

}  // namespace rtu::study
