#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "model/traversal.hpp"
#include "vectors.hpp"

namespace rtu::test {

/// A node and a ray with its interval. The references in the node do not matter.
template <std::uint32_t Width>
struct BoxVector {
    model::Node<Width> node{};
    model::RaySetup ray;
    float t_end = 0;
    std::uint8_t tag = 0;
};

/// What the model makes of a vector.
template <std::uint32_t Width>
class BoxReference {
  public:
    BoxReference() {
        image_.width = Width;
        image_.depth = 1;
        image_.blocks.resize(sizeof(model::Node<Width>) / model::image_block_bytes);
    }
    /// The children that the ray meets, the nearest on top; a child's address is 64 times its index.
    const model::TraversalStack& visit(const BoxVector<Width>& vector) {
        model::Node<Width> node = vector.node;
        for (std::uint32_t i = 0; i < Width; ++i)
            node.child[i] = model::NodeRef::inner(std::uint64_t{64} * i);
        std::memcpy(image_.blocks.data(), &node, sizeof node);
        traversal_.ray = vector.ray;
        traversal_.closest.hit.t = vector.t_end;
        traversal_.current.ref = image_.root();
        traversal_.stack.reset(model::stack_capacity(image_));
        model::visit_node(traversal_, image_);
        return traversal_.stack;
    }

  private:
    model::MemoryImage image_;
    model::Traversal traversal_;
};

template <class Port>
void set_vector(Port& port, const model::Vec3& v) {
    std::memcpy(&port, &v, sizeof v);
}

/// Sets the inputs of a Verilated box_tester.
template <class Unit, std::uint32_t Width>
void drive(Unit& unit, const BoxVector<Width>& vector) {
    static_assert(sizeof unit.planes_i == sizeof vector.node.planes);
    std::memcpy(&unit.planes_i, &vector.node.planes, sizeof unit.planes_i);
    const model::RaySetup& ray = vector.ray;
    unit.tag_i = vector.tag;
    unit.child_count_i = std::uint8_t(vector.node.child_count);
    unit.entry_side_i = std::uint8_t(ray.entry_side[0] | ray.entry_side[1] << 1 | ray.entry_side[2] << 2);
    set_vector(unit.origin_near_i, ray.origin_near);
    set_vector(unit.origin_far_i, ray.origin_far);
    set_vector(unit.inv_direction_i, ray.inv_direction);
    unit.t_min_i = bits_of(ray.t_min);
    unit.t_end_i = bits_of(vector.t_end);
}

/// Asserts that the unit's outputs are the model's to the bit.
template <class Unit, std::uint32_t Width>
void expect_as_model(const Unit& unit, const BoxVector<Width>& vector, BoxReference<Width>& reference) {
    model::TraversalStack stack = reference.visit(vector);
    std::array<std::uint32_t, Width> t_near{};
    std::memcpy(&t_near, &unit.t_near_o, sizeof t_near);
    ASSERT_EQ(unit.tag_o, vector.tag);
    ASSERT_EQ(unit.count_o, stack.size());
    for (std::uint32_t place = 0; place < Width; ++place) {
        const std::uint32_t child = (std::uint32_t(unit.child_o) >> (3 * place)) & 7U;
        if (place >= unit.count_o) {
            ASSERT_EQ(child, 0U);
            ASSERT_EQ(t_near[place], 0U);
            continue;
        }
        const model::StackEntry expected = stack.pop();
        ASSERT_EQ(child, expected.ref.address() / 64) << "at place " << place;
        ASSERT_EQ(t_near[place], bits_of(expected.t_near)) << "at place " << place;
    }
}

}  // namespace rtu::test
