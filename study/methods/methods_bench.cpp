#include "study/methods/methods_bench.hpp"

#include <time.h>

#include <algorithm>
#include <limits>

namespace rtu::study {

namespace {

using model::methods::Kernel;
using model::methods::PreparedTriangles;
using model::methods::RayResult;

template <class Work>
double seconds_of(Work work) {
    const double begin = thread_cpu_seconds();
    work();
    return thread_cpu_seconds() - begin;
}

// Least times of one kernel.
struct Times {
    double store = std::numeric_limits<double>::infinity();
    double first_pass = store, shrinking = store, worst = store;
};

// Passes in a row over the same rays. A branch predictor learns their outcomes: with 15, vector code is up to
// twice as fast as with 5.
constexpr int most_passes = 15;
constexpr double enough_seconds = 0.02;

struct Candidate {
    Kernel kernel;
    PreparedTriangles triangles;
    std::vector<RayResult> results;
    Times least;
};

void time_once(const MethodsWorkload& workload, Candidate& one) {
    Times& least = one.least;
    least.store =
        std::min(least.store, seconds_of([&] { one.kernel.store(workload.triangles, one.triangles); }));
    const auto trace = [&](bool shrinks) {
        return seconds_of([&] { one.kernel.trace(one.triangles, workload.rays, shrinks, one.results); });
    };
    least.first_pass = std::min(least.first_pass, trace(true));
    const auto trace_often = [&](bool shrinks, double& shortest) {
        double spent = 0;
        for (int pass = 0; pass < most_passes && spent < enough_seconds; ++pass) {
            const double seconds = trace(shrinks);
            shortest = std::min(shortest, seconds);
            spent += seconds;
        }
    };
    trace_often(true, least.shrinking);
    trace_often(false, least.worst);  // last: its results give the share of hits
}

MethodsRow row_of(const Candidate& one, const MethodsWorkload& workload) {
    const std::uint64_t tests = workload.triangles.size() * workload.rays.size();
    std::uint64_t hits = 0;
    for (const RayResult& result : one.results) hits += result.hit_count;
    return {.kernel = one.kernel,
            .workload = "random",
            .tests_per_second = double(tests) / one.least.shrinking,
            .first_pass_tests_per_second = double(tests) / one.least.first_pass,
            .worst_tests_per_second = double(tests) / one.least.worst,
            .precompute_triangles_per_second = double(workload.triangles.size()) / one.least.store,
            .tests = tests,
            .hit_share = double(hits) / double(tests)};
}

}  // namespace

double thread_cpu_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

std::vector<MethodsRow> measure_methods(std::span<const Kernel> kernels, const MethodsWorkload& workload,
                                        std::uint32_t repeats, const MethodsProgress& progress) {
    std::vector<Candidate> candidates;
    for (const Kernel& kernel : kernels)
        candidates.push_back({kernel, {}, std::vector<RayResult>(workload.rays.size()), {}});
    for (std::uint32_t repeat = 0; repeat < repeats; ++repeat) {
        for (Candidate& one : candidates) time_once(workload, one);
        progress(double(repeat + 1) / repeats);
    }
    std::vector<MethodsRow> rows;
    for (const Candidate& one : candidates) rows.push_back(row_of(one, workload));
    return rows;
}

std::vector<MethodsScalingRow> measure_scaling(const Kernel& kernel, std::uint64_t seed,
                                               std::uint32_t repeats) {
    constexpr std::uint32_t triangle_count = 1024;
    std::vector<MethodsScalingRow> rows;
    for (std::uint32_t rays = 16; rays <= 4096; rays *= 4) {
        const MethodsWorkload workload = random_methods_workload(triangle_count, rays, seed);
        PreparedTriangles triangles;
        kernel.store(workload.triangles, triangles);
        std::vector<RayResult> results(rays);
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t repeat = 0; repeat < repeats; ++repeat)
            least =
                std::min(least, seconds_of([&] { kernel.trace(triangles, workload.rays, false, results); }));
        rows.push_back({std::string(kernel.method.name), std::uint64_t{triangle_count} * rays, least});
    }
    return rows;
}

double measure_clock_hz() {
    constexpr std::uint32_t rounds = 200'000, unrolled = 16;
    double least = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < 9; ++repeat) {
        std::uint64_t sum = 0;
        least = std::min(least, seconds_of([&] {
                             for (std::uint32_t round = 0; round < rounds; ++round) {
#pragma GCC unroll 16
                                 for (std::uint32_t i = 0; i < unrolled; ++i) {
                                     sum += round;
                                     asm volatile("" : "+r"(sum));  // keeps every addition, one after another
                                 }
                             }
                         }));
    }
    return double(rounds) * unrolled / least;
}

}  // namespace rtu::study
