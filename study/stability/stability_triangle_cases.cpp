#include <fmt/format.h>

#include <array>
#include <utility>

#include "study/stability/stability_cases.hpp"
#include "study/stability/stability_probes.hpp"

namespace rtu::study {
namespace {

StabilitySetting on_triangle(std::string parameter, std::string aim, DrawProbe draw) {
    return {std::move(parameter), std::move(aim),
            [draw = std::move(draw)] { return triangle_experiment(draw); }};
}

constexpr std::array<std::pair<const char*, Target>, 2> inside_and_edge{
    {{"inside", Target::Inside}, {"edge", Target::Edge}}};

StabilityCase grazing() {
    StabilityCase result{6, "grazing", "grazing rays", "the decision of exact arithmetic", {}};
    for (const char* angle : {"1e-1", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7"}) {
        result.settings.push_back(
            on_triangle(fmt::format("{} rad", angle), "inside", probe_at_angle(std::strtof(angle, nullptr))));
    }
    return result;
}

StabilityCase slivers() {
    StabilityCase result{7, "slivers", "slivers and needles", "the decision of exact arithmetic", {}};
    for (const char* ratio : {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8"}) {
        for (const auto& [aim, target] : inside_and_edge) {
            result.settings.push_back(
                on_triangle(ratio, aim, probe_of_sliver(std::strtof(ratio, nullptr), target)));
        }
    }
    return result;
}

StabilityCase degenerate() {
    StabilityCase result{8, "degenerate", "triangles without area", "no hit", {}};
    const std::array<std::pair<const char*, Degeneracy>, 5> kinds{
        {{"one point", Degeneracy::OnePoint},
         {"two points", Degeneracy::TwoPoints},
         {"on a line", Degeneracy::Collinear},
         {"nearly on a line", Degeneracy::NearlyCollinear},
         {"edge-on", Degeneracy::EdgeOn}}};
    for (const auto& [name, kind] : kinds) {
        result.settings.push_back(on_triangle(name, "at_it", probe_of_degenerate(kind)));
    }
    return result;
}

StabilityCase tiny() {
    StabilityCase result{9, "tiny", "tiny triangles", "the decision of exact arithmetic", {}};
    for (const char* size : {"1e-2", "1e-4", "1e-6", "1e-8", "1e-12", "1e-16", "1e-20"}) {
        const float length = std::strtof(size, nullptr);
        result.settings.push_back(on_triangle(fmt::format("{}, near", size), "around",
                                              probe_of_size(length, 3 * length, 0, Target::Around)));
        result.settings.push_back(on_triangle(fmt::format("{} from 1", size), "around",
                                              probe_of_size(length, 1, 0, Target::Around)));
    }
    for (const char* distance : {"1e3", "1e6"}) {
        result.settings.push_back(
            on_triangle(fmt::format("1e-2 from {}", distance), "around",
                        probe_of_size(1e-2F, std::strtof(distance, nullptr), 0, Target::Around)));
    }
    for (const char* offset : {"1", "1e3"}) {
        result.settings.push_back(
            on_triangle(fmt::format("1e-2 at {}", offset), "around",
                        probe_of_size(1e-2F, 1, std::strtof(offset, nullptr), Target::Around)));
    }
    return result;
}

StabilityCase huge() {
    StabilityCase result{10, "huge", "huge triangles", "the decision of exact arithmetic, no overflow", {}};
    for (const char* size : {"1e6", "1e9", "1e12", "1e15", "1e18", "1e19"}) {
        const float length = std::strtof(size, nullptr);
        result.settings.push_back(
            on_triangle(size, "around", probe_of_size(length, 3 * length, 0, Target::Around)));
    }
    return result;
}

StabilityCase scale_mix() {
    StabilityCase result{
        11, "scale_mix", "coordinates of all magnitudes", "the decision of exact arithmetic", {}};
    for (const int decades : {2, 4, 8, 12}) {
        result.settings.push_back(on_triangle(fmt::format("10^-{0} to 10^{0}", decades), "inside",
                                              probe_of_mixed_scales(float(decades))));
    }
    return result;
}

StabilityCase direction_length() {
    StabilityCase result{12,
                         "direction_length",
                         "long, short and subnormal directions",
                         "the decision of exact arithmetic",
                         {}};
    for (const char* length :
         {"0", "1e-44", "1e-40", "1e-38", "1e-30", "1e-20", "1e-6", "1", "1e6", "1e20", "1e30", "1e38"}) {
        result.settings.push_back(
            on_triangle(length, "around", probe_of_direction_length(std::strtod(length, nullptr))));
    }
    if (!can_flush_subnormals()) return result;
    for (const char* length : {"1e-40", "1e-38", "1e-30", "1"}) {
        result.settings.push_back({fmt::format("{}, flushed", length), "around", [length] {
                                       return triangle_experiment(
                                           probe_of_direction_length(std::strtod(length, nullptr)),
                                           Subnormals::Flushed);
                                   }});
    }
    return result;
}

StabilityCase t_range() {
    StabilityCase result{
        13, "t_range", "ends of the ray's interval", "the interval is open, its ends exact", {}};
    const std::array<std::pair<const char*, IntervalEnd>, 5> ends{
        {{"t_min = t", IntervalEnd::MinAtT},
         {"t_min < t by 1 ulp", IntervalEnd::MinBelowT},
         {"t_max = t", IntervalEnd::MaxAtT},
         {"t_max > t by 1 ulp", IntervalEnd::MaxAboveT},
         {"t_min = t_max = t", IntervalEnd::BothAtT}}};
    for (const auto& [scale, exponent] :
         {std::pair("", 0), {", t about 1e-30", -100}, {", t about 1e30", 100}}) {
        for (const auto& [name, end] : ends) {
            result.settings.push_back(
                on_triangle(fmt::format("{}{}", name, scale), "inside", probe_of_interval(end, exponent)));
        }
    }
    result.settings.push_back(on_triangle("origin on the surface", "off_surface",
                                          probe_of_interval(IntervalEnd::OriginOnSurface, 0)));
    return result;
}

StabilityCase not_finite() {
    StabilityCase result{
        14, "not_finite", "NaN and infinity in ray and triangle", "no hit, nothing non-finite", {}};
    const std::array<std::pair<const char*, Spoilt>, 9> kinds{
        {{"origin NaN", Spoilt::OriginNan},
         {"direction NaN", Spoilt::DirectionNan},
         {"t_min NaN", Spoilt::MinNan},
         {"t_max NaN", Spoilt::MaxNan},
         {"vertex x NaN", Spoilt::VertexNanX},
         {"vertex y or z NaN", Spoilt::VertexNanYz},
         {"origin infinite", Spoilt::OriginInfinite},
         {"direction infinite", Spoilt::DirectionInfinite},
         {"vertex infinite", Spoilt::VertexInfinite}}};
    for (const auto& [name, kind] : kinds) {
        result.settings.push_back(on_triangle(name, "inside", probe_of_spoilt(kind)));
    }
    return result;
}

// The chance of a wrong decision by the distance from the edge, for which the other cases have the largest
// only.
StabilityCase beside_edge() {
    StabilityCase result{24,
                         "beside_edge",
                         "rays a few units in the last place from an edge",
                         "the decision of exact arithmetic",
                         {}};
    for (const float ulps : {0.0F, 0.5F, 1.0F, 2.0F, 4.0F, 16.0F, 64.0F, 256.0F, 1024.0F}) {
        result.settings.push_back(on_triangle(fmt::format("{} ulps", ulps), "edge", probe_beside_edge(ulps)));
    }
    return result;
}

// Not a way to fail: what ordinary rays get, to which the other cases compare.
StabilityCase ordinary() {
    StabilityCase result{
        0, "ordinary", "triangles and rays in a cube", "the decision of exact arithmetic", {}};
    result.settings.push_back(on_triangle("unit cube", "around", probe_of_size(1, 3, 0, Target::Around)));
    for (const char* offset : {"1e3", "1e5"}) {
        result.settings.push_back(
            on_triangle(fmt::format("offset {}", offset), "around",
                        probe_of_size(1, 3, std::strtof(offset, nullptr), Target::Around)));
    }
    return result;
}

}  // namespace

std::vector<StabilityCase> triangle_cases() {
    return {ordinary(),  grazing(),          slivers(), degenerate(), tiny(),       huge(),
            scale_mix(), direction_length(), t_range(), not_finite(), beside_edge()};
}

}  // namespace rtu::study
