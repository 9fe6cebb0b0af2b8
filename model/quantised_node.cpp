#include "model/quantised_node.hpp"

#include <algorithm>
#include <cmath>
#include <new>

namespace rtu::model {

namespace {

constexpr std::uint32_t last_step = 255;
constexpr int exponent_bias = 127, least_exponent = 1, most_exponent = 254;

// The finest step with which 255 steps reach `end`. With the coarsest they reach infinity.
template <std::uint32_t Width>
std::uint8_t finest_exponent(const QuantisedNode<Width>& coarse, std::size_t axis, float end) {
    QuantisedNode<Width> node = coarse;
    const double extent = double(end) - double(node.origin[axis]);
    // Rounding may make it one or two more or fewer.
    const int guess = extent > 0 ? std::ilogb(extent / last_step) + exponent_bias : least_exponent;
    const auto reaches = [&](int exponent) {
        node.exponent[axis] = std::uint8_t(exponent);
        return node.plane(axis, last_step) >= end;
    };
    int exponent = std::clamp(guess, least_exponent, most_exponent);
    while (exponent > least_exponent && reaches(exponent - 1)) --exponent;
    while (!reaches(exponent)) ++exponent;
    return std::uint8_t(exponent);
}

// About as many steps as lead to `value`; rounding may make it one or two more or fewer.
template <std::uint32_t Width>
std::uint32_t near_steps(const QuantisedNode<Width>& node, std::size_t axis, float value) {
    const double steps = (double(value) - double(node.origin[axis])) / double(node.step(axis));
    return std::uint32_t(std::clamp(steps, 0.0, double(last_step)));
}

template <std::uint32_t Width>
std::uint8_t steps_below(const QuantisedNode<Width>& node, std::size_t axis, float lo) {
    std::uint32_t steps = near_steps(node, axis, lo);
    while (steps > 0 && node.plane(axis, steps) > lo) --steps;
    while (steps < last_step && node.plane(axis, steps + 1) <= lo) ++steps;
    return std::uint8_t(steps);
}

template <std::uint32_t Width>
std::uint8_t steps_above(const QuantisedNode<Width>& node, std::size_t axis, float hi) {
    std::uint32_t steps = near_steps(node, axis, hi);
    while (steps < last_step && node.plane(axis, steps) < hi) ++steps;
    while (steps > 0 && node.plane(axis, steps - 1) >= hi) --steps;
    return std::uint8_t(steps);
}

template <std::uint32_t Width>
class ImageQuantiser {
  public:
    explicit ImageQuantiser(const MemoryImage& full)
        : full_(full), next_leaf_(full.node_count * sizeof(QuantisedNode<Width>)) {
        image_.bounds = full.bounds;
        image_.width = Width;
        image_.format = NodeFormat::Quantised;
        image_.depth = full.depth;
        image_.node_count = full.node_count;
        image_.leaf_count = full.leaf_count;
        image_.pair_count = full.pair_count;
        image_.reference_count = full.reference_count;
        image_.blocks.resize(next_leaf_ / image_block_bytes + full.pair_count);
        image_.exact_nodes.resize(full.node_count * sizeof(Node<Width>) / image_block_bytes);
    }

    MemoryImage run() {
        next_node_ = sizeof(QuantisedNode<Width>);
        write(full_.root(), image_.root());
        return std::move(image_);
    }

  private:
    void write(NodeRef from, NodeRef to) {
        Node<Width> node = full_.node<Width>(from);
        const std::array<NodeRef, Width> children = node.child;
        for (std::uint32_t i = 0; i < node.child_count; ++i) node.child[i] = place(children[i]);
        new (&image_.blocks[to.address() / image_block_bytes]) QuantisedNode<Width>(quantise(node));
        const std::uint64_t index = to.address() / sizeof(QuantisedNode<Width>);
        new (&image_.exact_nodes[index * sizeof(Node<Width>) / image_block_bytes]) Node<Width>(node);
        for (std::uint32_t i = 0; i < node.child_count; ++i) {
            if (!children[i].is_leaf()) write(children[i], node.child[i]);
        }
    }

    // The next free place for a child. A leaf is moved there, a node only knows it.
    NodeRef place(NodeRef child) {
        if (!child.is_leaf()) {
            const NodeRef ref = NodeRef::inner(next_node_);
            next_node_ += sizeof(QuantisedNode<Width>);
            return ref;
        }
        const NodeRef ref = NodeRef::leaf(next_leaf_, child.pair_count());
        std::copy_n(&full_.blocks[child.address() / image_block_bytes], child.pair_count(),
                    &image_.blocks[next_leaf_ / image_block_bytes]);
        next_leaf_ += std::uint64_t(child.pair_count()) * image_block_bytes;
        return ref;
    }

    const MemoryImage& full_;
    MemoryImage image_;
    std::uint64_t next_node_ = 0;
    std::uint64_t next_leaf_;
};

}  // namespace

template <std::uint32_t Width>
QuantisedNode<Width> quantise(const Node<Width>& node) {
    QuantisedNode<Width> result{};
    Aabb whole;
    for (std::uint32_t i = 0; i < node.child_count; ++i) whole.extend(node.box(i));
    result.child_count = std::uint8_t(node.child_count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result.origin[axis] = whole.lo[axis];
        result.exponent[axis] = finest_exponent(result, axis, whole.hi[axis]);
        for (std::size_t i = 0; i < Width; ++i) {
            const bool is_used = i < node.child_count;
            const Aabb box = node.box(i);
            result.planes[0][axis][i] = is_used ? steps_below(result, axis, box.lo[axis]) : last_step;
            result.planes[1][axis][i] = is_used ? steps_above(result, axis, box.hi[axis]) : 0;
        }
    }
    for (std::size_t i = node.child_count; i-- > 0;) {
        const NodeRef child = node.child[i];
        const auto block = std::uint32_t(child.address() / image_block_bytes);
        (child.is_leaf() ? result.first_leaf : result.first_node) = block;
        if (child.is_leaf()) {
            result.kinds[i / 2] |= std::uint8_t((8U | (child.pair_count() - 1)) << (i % 2 * 4));
        }
    }
    return result;
}

template QuantisedNode<2> quantise(const Node<2>&);
template QuantisedNode<4> quantise(const Node<4>&);
template QuantisedNode<6> quantise(const Node<6>&);
template QuantisedNode<8> quantise(const Node<8>&);

MemoryImage quantise_nodes(const MemoryImage& full) {
    switch (full.width) {
        case 2:
            return ImageQuantiser<2>(full).run();
        case 4:
            return ImageQuantiser<4>(full).run();
        case 6:
            return ImageQuantiser<6>(full).run();
        default:
            return ImageQuantiser<8>(full).run();
    }
}

}  // namespace rtu::model
