#pragma once

#include <span>

#include "model/methods/method.hpp"

namespace rtu::model::methods {

/// The methods as a compiler makes them that may fuse a * b + c: what a project gets that does not ask for
/// -ffp-contract=off. Empty on a processor without fused multiply-add.
[[nodiscard]] std::span<const Method> contracted_methods();

}  // namespace rtu::model::methods
