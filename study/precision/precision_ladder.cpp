#include "study/precision/precision_ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/methods/emulated.hpp"
#include "model/methods/exact.hpp"
#include "model/methods/operation_counts.hpp"
#include "model/methods/quantised_filter.hpp"
#include "model/parallel.hpp"
#include "study/precision/precision_area.hpp"
#include "study/scene_steps.hpp"
#include "study/version.hpp"

namespace rtu::study {
namespace {

using model::Ray;
using model::Vec3;
using model::methods::Corners;
using model::methods::EmulatedMethod;
using model::methods::NumberFormat;
using model::methods::test_exactly;

// t of a test that is exactly hit, in binary64.
double distance(const Ray& ray, const Corners& triangle) {
    const auto wide = [](Vec3 v) { return std::array{double(v.x), double(v.y), double(v.z)}; };
    const auto a = wide(triangle[0]), b = wide(triangle[1]), c = wide(triangle[2]);
    const auto o = wide(ray.origin), d = wide(ray.direction);
    double to_plane = 0, along = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const double n = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
        to_plane += (a[i] - o[i]) * n;
        along += d[i] * n;
    }
    return to_plane / along;
}

// A unit in the last place of `t` in binary32.
double ulp_of(double t) { return std::ldexp(1.0, std::max(std::ilogb(t), -126) - 23); }

// What all rows are compared with: the exact distance of each test, in order; nothing for a miss.
struct Reference {
    std::vector<std::vector<std::optional<double>>> distances;  // [rays][triangles]
    std::vector<std::optional<double>> nearest;                 // [rays]
};

Reference reference_of(std::span<const RayTriangles> rays) {
    Reference reference;
    for (const RayTriangles& one : rays) {
        auto& distances = reference.distances.emplace_back();
        auto& nearest = reference.nearest.emplace_back();
        for (const Corners& triangle : one.triangles) {
            const bool is_hit = test_exactly(one.ray, triangle).has_value();
            distances.push_back(is_hit ? std::optional(distance(one.ray, triangle)) : std::nullopt);
            if (is_hit && (!nearest || *distances.back() < *nearest)) nearest = distances.back();
        }
    }
    return reference;
}

// A method in one format: the distance of a hit.
using Test = std::function<std::optional<double>(const Ray&, const Corners&)>;

// A one-sided method is asked for both windings.
Test test_of(const EmulatedMethod& method, NumberFormat format) {
    return [test = method.test, is_one_sided = method.info.is_one_sided, format](
               const Ray& ray, const Corners& triangle) -> std::optional<double> {
        auto hit = test(ray, triangle, format);
        if (!hit && is_one_sided) hit = test(ray, {triangle[0], triangle[2], triangle[1]}, format);
        return hit ? std::optional(hit->t) : std::nullopt;
    };
}

Test exact_test(NumberFormat format) {
    return [format](const Ray& ray, const Corners& triangle) -> std::optional<double> {
        const Ray narrow_ray = rounded(format, ray);
        const Corners narrow = rounded(format, triangle);
        if (!test_exactly(narrow_ray, narrow)) return std::nullopt;
        return distance(narrow_ray, narrow);
    };
}

void judge_errors(std::vector<double>& errors, PrecisionRow& row) {
    if (errors.empty()) return;
    std::ranges::sort(errors);
    const auto at = [&](double share) {
        const auto rank = std::size_t(std::ceil(share * double(errors.size())));
        return errors[std::max<std::size_t>(rank, 1) - 1];
    };
    row.t_ulp_p50 = at(0.5);
    row.t_ulp_p99 = at(0.99);
    row.t_ulp_max = errors.back();
}

void judge_sampled(std::span<const RayTriangles> rays, const Reference& reference, const Test& test,
                   double tolerance, PrecisionRow& row) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        std::optional<double> nearest;
        for (std::size_t k = 0; k < rays[i].triangles.size(); ++k) {
            const auto t = test(rays[i].ray, rays[i].triangles[k]);
            const auto& exact = reference.distances[i][k];
            row.tests += 1;
            row.false_hits += t && !exact ? 1 : 0;
            row.false_misses += exact && !t ? 1 : 0;
            if (t && !(nearest && *nearest <= *t)) nearest = t;  // NaN too
            if (t && exact) {
                const double error = std::abs(*t - *exact) / ulp_of(*exact);
                errors.push_back(std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
            }
        }
        const auto& expected = reference.nearest[i];
        row.rays += 1;
        row.lost += expected && !nearest ? 1 : 0;
        row.gained += nearest && !expected ? 1 : 0;
        row.moved +=
            nearest && expected && !(std::abs(*nearest - *expected) <= tolerance * *expected) ? 1 : 0;
    }
    judge_errors(errors, row);
}

void judge_aimed(std::span<const RayTriangles> rays, std::span<const std::uint32_t> exact_hits,
                 const Test& test, PrecisionRow& row) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (exact_hits[i] == 0) continue;
        std::uint32_t hits = 0;
        for (const Corners& triangle : rays[i].triangles) hits += test(rays[i].ray, triangle) ? 1 : 0;
        row.aimed_rays += 1;
        row.leaks += hits == 0 ? 1 : 0;
        row.doubles += hits > exact_hits[i] ? 1 : 0;
    }
}

// Numbers that the ray and the triangle are rounded to decide what is exact at an edge: rounding moves the
// ray off the edge that it was aimed at.
std::vector<std::uint32_t> exact_hits_of(std::span<const RayTriangles> rays, const Test& exact) {
    std::vector<std::uint32_t> hits;
    for (const RayTriangles& one : rays) {
        std::uint32_t& count = hits.emplace_back(0);
        for (const Corners& triangle : one.triangles) count += exact(one.ray, triangle) ? 1 : 0;
    }
    return hits;
}

std::vector<EmulatedMethod> chosen_methods(const PrecisionOptions& options) {
    std::vector<EmulatedMethod> chosen;
    for (const EmulatedMethod& method : model::methods::emulated_methods()) {
        const auto is_method = [&](const std::string& name) { return name == method.info.name; };
        if (options.methods.empty() || std::ranges::any_of(options.methods, is_method)) {
            chosen.push_back(method);
        }
    }
    return chosen;
}

// Wider formats of the same exponent are good enough, too.
bool is_steady(const PrecisionReport& report, const PrecisionRow& row) {
    const auto rungs = ladder(report, row.scene, row.method, row.format.exponent_bits);
    return std::ranges::all_of(rungs, [&](const PrecisionRow* rung) {
        return rung->format.mantissa_bits < row.format.mantissa_bits || rung->is_enough;
    });
}

std::optional<std::size_t> cheapest(const PrecisionReport& report, const std::string& scene,
                                    bool must_be_watertight) {
    const PrecisionRow* best = nullptr;
    const auto price = [](const PrecisionRow& row) { return std::pair(*row.area, row.format.width_bits()); };
    for (const PrecisionRow& row : report.rows) {
        if (row.scene != scene || !row.area || !row.is_enough || !is_steady(report, row)) continue;
        if (must_be_watertight && !row.is_watertight()) continue;
        if (best == nullptr || price(row) < price(*best)) best = &row;
    }
    return best == nullptr ? std::nullopt : std::optional(std::size_t(best - report.rows.data()));
}

}  // namespace

std::vector<NumberFormat> ladder_formats() {
    std::vector<NumberFormat> formats{{5, 10}};
    for (const int exponent : {8, 10}) {
        for (int mantissa = 7; mantissa <= 23; ++mantissa) {
            formats.push_back({std::uint8_t(exponent), std::uint8_t(mantissa)});
        }
    }
    return formats;
}

PrecisionRays precision_rays(const SceneSource& source, const PrecisionOptions& options) {
    constexpr model::Resolution resolution{256, 256};  // of the pictures that the rays are sampled from
    const LoadedScene loaded = load_scene(source);
    const BuiltScene built = build_scene(loaded.mesh, {model::PairingKind::EdgeBbsa, 0},
                                         model::EdgeIdentity::Position, sim::Config{}.bvh);
    const ChosenCamera chosen = choose_camera(loaded.mesh, built.image, source, options.camera_file);
    PrecisionRays rays;
    for (const model::WorkloadKind kind : options.workloads) {
        const model::Workload workload =
            make_workload(kind, loaded.mesh, built.image, chosen.camera, resolution, options.seed);
        const auto more = sampled_rays(loaded.mesh, built.image, workload, options.ray_count, options.seed);
        rays.sampled.insert(rays.sampled.end(), more.begin(), more.end());
        if (!rays.aimed.empty()) continue;
        rays.aimed = aimed_rays(loaded.mesh, built.image, workload, options.ray_count, options.seed);
    }
    return rays;
}

std::vector<PrecisionRow> precision_rows(const std::string& scene, const PrecisionRays& rays,
                                         const PrecisionOptions& options) {
    const std::vector<NumberFormat> formats = ladder_formats();
    const std::vector<EmulatedMethod> methods = chosen_methods(options);
    const Reference reference = reference_of(rays.sampled);
    std::vector<PrecisionRow> rows((methods.size() + 1) * formats.size());
    const auto judge_format = [&](std::size_t f) {
        const NumberFormat format = formats[f];
        const Test exact = exact_test(format);
        const std::vector<std::uint32_t> exact_hits = exact_hits_of(rays.aimed, exact);
        for (std::size_t m = 0; m <= methods.size(); ++m) {
            PrecisionRow& row = rows[m * formats.size() + f];
            const bool is_exact = m == methods.size();
            const model::methods::MethodInfo& info = is_exact ? model::methods::exact_info : methods[m].info;
            const Test test = is_exact ? exact : test_of(methods[m], format);
            row.scene = scene;
            row.method = info.name;
            row.format = format;
            row.triangle_bits = info.stored_bytes / 4 * std::uint32_t(format.width_bits());
            if (!is_exact) row.area = area_proxy(model::methods::counts_of(info.name)->single.hit, format);
            judge_sampled(rays.sampled, reference, test, options.t_tolerance, row);
            judge_aimed(rays.aimed, exact_hits, test, row);
            row.is_enough = upper_rate_per_million(row.wrong(), row.rays) <= options.wrong_per_million;
        }
    };
    model::for_each_range<std::size_t>(formats.size(), 1, [&](const auto& range) {
        for (std::size_t f = range.begin(); f != range.end(); ++f) judge_format(f);
    });
    return rows;
}

std::vector<FilterRow> filter_rows(const std::string& scene, std::span<const RayTriangles> rays) {
    using model::methods::QuantisedFilter;
    std::vector<FilterRow> rows;
    for (std::uint8_t bits = 1; bits <= 12; ++bits) {
        FilterRow& row = rows.emplace_back(FilterRow{.scene = scene, .format = {8, bits}});
        row.area = area_proxy(QuantisedFilter::operations(), row.format);
    }
    for (const RayTriangles& one : rays) {
        if (!can_hit(one.ray)) continue;
        std::vector<QuantisedFilter> filters;
        for (const FilterRow& row : rows) filters.emplace_back(one.ray, row.format);
        for (const Corners& triangle : one.triangles) {
            const bool is_hit = test_exactly(one.ray, triangle).has_value();
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const bool has_passed = filters[i].may_hit(triangle);
                rows[i].tests += 1;
                rows[i].hits += is_hit ? 1 : 0;
                rows[i].passed += has_passed ? 1 : 0;
                rows[i].false_negatives += is_hit && !has_passed ? 1 : 0;
            }
        }
    }
    return rows;
}

PrecisionReport run_precision_study(const PrecisionOptions& options) {
    PrecisionReport report;
    report.version = version();
    report.seed = options.seed;
    report.t_tolerance = options.t_tolerance;
    report.wrong_per_million = options.wrong_per_million;
    for (const SceneSource& source : options.scenes) {
        const auto tell = [&](std::string_view phase) {
            if (options.progress) options.progress(fmt::format("{}: {}", source.name(), phase));
        };
        tell("reading");
        const PrecisionRays rays = precision_rays(source, options);
        tell("testing in every format");
        for (PrecisionRow& row : precision_rows(source.name(), rays, options)) {
            report.rows.push_back(std::move(row));
        }
        for (FilterRow& row : filter_rows(source.name(), rays.sampled)) {
            report.filters.push_back(std::move(row));
        }
        PrecisionAnswer answer;
        answer.scene = source.name();
        answer.rays = rays.sampled.size();
        for (const model::WorkloadKind kind : options.workloads) {
            answer.workloads.emplace_back(to_string(kind));
        }
        answer.row = cheapest(report, source.name(), false);
        answer.watertight_row = cheapest(report, source.name(), true);
        report.scenes.push_back(std::move(answer));
    }
    return report;
}

}  // namespace rtu::study
