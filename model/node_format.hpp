#pragma once

#include <cstdint>
#include <string_view>

namespace rtu::model {

/// How an inner node holds the boxes of its children.
enum class NodeFormat : std::uint8_t {
    Full,       ///< binary32 planes: memory_image.hpp
    Quantised,  ///< 8-bit planes on a grid of the node: quantised_node.hpp
};

/// `full` or `quantised`.
[[nodiscard]] constexpr std::string_view to_string(NodeFormat format) {
    return format == NodeFormat::Full ? "full" : "quantised";
}

}  // namespace rtu::model
