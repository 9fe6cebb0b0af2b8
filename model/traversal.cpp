#include "model/traversal.hpp"

#include <algorithm>
#include <bit>

#include "model/error.hpp"
#include "model/pair_test.hpp"
#include "model/slab_test.hpp"

namespace rtu::model {

namespace {

// Calls `f` with the tree's width as a constant.
template <class F>
auto with_width(const MemoryImage& image, F f) {
    switch (image.width) {
        case 2:
            return f.template operator()<2>();
        case 4:
            return f.template operator()<4>();
        case 6:
            return f.template operator()<6>();
        default:
            return f.template operator()<8>();
    }
}

// Pushes the children that the ray enters so that the nearest lies on top, and of equally near ones the
// lowest index. Returns the number of boxes tested.
template <std::uint32_t Width>
[[gnu::always_inline]] inline std::uint32_t push_children(const Node<Width>& node,
                                                          const SlabRay<slab_lanes<Width>>& ray, float t_end,
                                                          TraversalStack& stack) {
    const SlabHits<Width> hits = slab_test(node, ray, t_end);
    const std::size_t base = stack.size();
    for (std::uint32_t mask = hits.mask; mask != 0; mask &= mask - 1) {
        const auto child = std::uint32_t(std::countr_zero(mask));
        const StackEntry entry{node.child[child], hits.t_near[child]};
        std::size_t place = stack.size();
        stack.push(entry);
        for (; place > base && stack[place - 1].t_near <= entry.t_near; --place)
            stack[place] = stack[place - 1];
        stack[place] = entry;
    }
    return node.child_count;
}

bool is_better(const Hit& hit, const Closest& closest) {
    if (hit.t < closest.hit.t) return true;
    return closest.is_found && hit.t == closest.hit.t && hit.primitive_id < closest.hit.primitive_id;
}

PairVisit update_closest(Closest& closest, const LeafPair& pair, const RaySetup& ray) {
    const PairHits found = test_pair(pair, ray);
    for (std::size_t i = 0; i < 2; ++i) {
        if (found.is_pierced[i] && is_better(found.hits[i], closest))
            closest = {found.hits[i], true};
    }
    return {pair.has_second() ? 2U : 1U, found.exact_tests};
}

// The whole traversal of one ray, with the tree's width known to the compiler and the ray's constants in
// registers.
template <std::uint32_t Width>
Closest run(const MemoryImage& image, const RaySetup& ray, RayKind kind, TraversalStack& stack,
            TraversalCounts& counts) {
    const SlabRay<slab_lanes<Width>> slab_ray(ray);
    Closest closest{Hit{.t = ray.t_max}};
    const auto is_done = [&] { return kind == RayKind::AnyHit && closest.is_found; };
    stack.push({image.root(), ray.t_min});
    while (stack.size() > 0 && !is_done()) {
        const StackEntry current = stack.pop();
        if (current.t_near > closest.hit.t) continue;
        if (!current.ref.is_leaf()) {
            counts.box_tests += push_children(image.node<Width>(current.ref), slab_ray, closest.hit.t, stack);
            ++counts.node_visits;
            continue;
        }
        for (std::uint32_t i = 0; i < current.ref.pair_count() && !is_done(); ++i) {
            const PairVisit visit = update_closest(closest, image.leaf_pair(current.ref, i), ray);
            counts.triangle_tests += visit.triangle_tests;
            ++counts.pair_tests;
        }
    }
    return closest;
}

}  // namespace

std::size_t stack_capacity(const MemoryImage& image) {
    // A visit pops one entry and pushes at most `width`.
    return std::size_t(image.width - 1) * image.depth + 1;
}

bool start(Traversal& traversal, const MemoryImage& image, const Ray& ray, RayKind kind) {
    traversal.kind = kind;
    traversal.closest = {Hit{.t = ray.t_max}};
    traversal.stack.reset(stack_capacity(image));
    if (!can_hit(ray)) return false;
    traversal.ray = make_ray_setup(ray, image.bounds);
    traversal.current = {image.root(), ray.t_min};
    return true;
}

std::uint32_t child_count(const MemoryImage& image, NodeRef ref) {
    return with_width(image, [&]<std::uint32_t Width>() { return image.node<Width>(ref).child_count; });
}

std::uint32_t visit_node(Traversal& traversal, const MemoryImage& image) {
    return with_width(image, [&]<std::uint32_t Width>() {
        return push_children(image.node<Width>(traversal.current.ref),
                             SlabRay<slab_lanes<Width>>(traversal.ray), traversal.closest.hit.t,
                             traversal.stack);
    });
}

PairVisit visit_pair(Traversal& traversal, const MemoryImage& image, std::uint32_t index) {
    return update_closest(traversal.closest, image.leaf_pair(traversal.current.ref, index), traversal.ray);
}

bool pop(Traversal& traversal, std::size_t floor) {
    while (traversal.stack.size() > floor) {
        traversal.current = traversal.stack.pop();
        if (traversal.current.t_near <= traversal.closest.hit.t) return true;
    }
    return false;
}

std::optional<Hit> trace(TraversalStack& stack, const MemoryImage& image, const Ray& ray, RayKind kind,
                         TraversalCounts* counts) {
    if (!can_hit(ray)) return std::nullopt;
    stack.reset(stack_capacity(image));
    TraversalCounts mine;
    const RaySetup setup = make_ray_setup(ray, image.bounds);
    const Closest closest =
        with_width(image, [&]<std::uint32_t Width>() { return run<Width>(image, setup, kind, stack, mine); });
    if (counts != nullptr) *counts += mine;
    return closest.is_found ? std::optional(closest.hit) : std::nullopt;
}

std::optional<Hit> trace(const MemoryImage& image, const Ray& ray, RayKind kind, TraversalCounts* counts) {
    TraversalStack stack;
    return trace(stack, image, ray, kind, counts);
}

}  // namespace rtu::model
