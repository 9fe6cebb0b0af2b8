#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/methods/early_exits.hpp"
#include "model/methods/kernel.hpp"

namespace rtu::study {

/// Speed of one method in one form and width on one workload, one thread of this host.
struct MethodsRow {
    model::methods::Kernel kernel;
    std::string workload;         ///< "random", or scene/rays: "bunny/primary"
    double tests_per_second = 0;  ///< ray-triangle tests; a hit shortens the ray
    /// The same on rays that the processor has not just seen: its branch predictor remembers the outcomes of
    /// a pass for the next one. Published figures are of repeated passes, as far as papers tell.
    std::optional<double> first_pass_tests_per_second;
    std::optional<double> worst_tests_per_second;  ///< repeated passes, all tests on the whole ray
    std::optional<double> precompute_triangles_per_second;
    std::uint64_t tests = 0;  ///< of one pass
    double hit_share = 0;     ///< hits / tests where rays are not shortened, else rays that hit
};

/// Tests a second against the number of tests, one method, scalar code: whether time is linear [RS04].
struct MethodsScalingRow {
    std::string method;
    std::uint64_t tests = 0;
    double seconds = 0;
};

/// What the halves of Shevtsov's test reject on a scene's own tests.
struct MethodsEarlyExits {
    std::string workload;  ///< scene/rays
    model::methods::EarlyExits exits;
};

/// Published speeds of one method, in millions a second, and where they stand.
struct PublishedSpeed {
    std::string_view method;
    double single = 0, single_worst = 0;
    std::optional<double> packets, packets_worst;
    double precompute = 0;
};

/// Tables I and II of [HH11], Microsoft compiler, Core 2 Duo E8200, packets of four.
[[nodiscard]] std::span<const PublishedSpeed> published_speeds();

struct MethodsReport {
    std::string version;
    std::string instruction_set;
    std::uint64_t seed = 0;
    std::uint32_t triangle_count = 0, ray_count = 0, repeats = 0;
    double clock_hz = 0;  ///< of the core, measured among the repeats
    std::vector<MethodsRow> rows;
    std::vector<MethodsScalingRow> scaling;
    std::vector<MethodsEarlyExits> early_exits;
};

}  // namespace rtu::study
