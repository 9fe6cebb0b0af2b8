#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "model/methods/counted.hpp"

namespace rtu::model::methods {

/// What a test of one triangle takes, by how it ends. Of directed rays at one triangle, past each of its
/// edges and on both sides of the interval.
struct SingleCounts {
    OperationCounts rejected;  ///< the miss that is decided soonest
    OperationCounts miss;      ///< the miss that is decided last
    OperationCounts hit;       ///< with t, u and v
    /// Of a hit, without the comparison of t with the interval and without the division if it is deferred.
    OperationCounts full;
};

/// What a test of a pair takes. As for SingleCounts, but for a pair in which both triangles are hit, which is
/// possible when it is folded, `both` and `both_full`.
struct PairCounts {
    OperationCounts rejected;
    OperationCounts one, one_full;
    OperationCounts both, both_full;
};

struct MethodCounts {
    std::string_view name;                                ///< of the method
    OperationCounts precomputation, pair_precomputation;  ///< of a triangle, of a pair
    SingleCounts single;
    std::optional<PairCounts> pair;  ///< of methods that have a pair form
};

/// The operations of every method that is a template, in their order; found by running it, nothing is typed
/// in. What a tie takes in woop_double and woop_top_left,
/// and a doubt in woop_exact, is not among them.
[[nodiscard]] std::span<const MethodCounts> operation_counts();

/// Of the method of that name; null when there is none.
[[nodiscard]] const MethodCounts* counts_of(std::string_view name);

}  // namespace rtu::model::methods
