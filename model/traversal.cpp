#include "model/traversal.hpp"

#include <algorithm>
#include <bit>

#include "model/error.hpp"
#include "model/pair_test.hpp"
#include "model/slab_test.hpp"

namespace rtu::model {

namespace {

// Pushes the children that the ray enters so that the nearest lies on top, and of equally near ones the
// lowest index.
template <std::uint32_t Width>
std::uint32_t visit(Traversal& traversal, const MemoryImage& image) {
    const Node<Width>& node = image.node<Width>(traversal.current.ref);
    const SlabHits<Width> hits = slab_test(node, traversal.ray, traversal.best.t);
    TraversalStack& stack = traversal.stack;
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

bool is_better(const Hit& hit, const Traversal& traversal) {
    if (!(hit.t > traversal.ray.t_min)) return false;
    if (hit.t < traversal.best.t) return true;
    return traversal.has_hit && hit.t == traversal.best.t && hit.primitive_id < traversal.best.primitive_id;
}

PairVisit visit(Traversal& traversal, const LeafPair& pair) {
    const PairHits found = test_pair(pair, traversal.ray, traversal.current.t_near);
    PairVisit visit{.triangle_tests = pair.has_second() ? 2U : 1U};
    for (std::size_t i = 0; i < 2; ++i) {
        if (!found.is_pierced[i]) continue;
        ++visit.pierced;
        if (is_better(found.hits[i], traversal)) {
            traversal.best = found.hits[i];
            traversal.has_hit = true;
        }
    }
    return visit;
}

bool pop_relevant(Traversal& traversal, std::size_t floor) {
    TraversalStack& stack = traversal.stack;
    while (stack.size() > floor) {
        traversal.current = stack.pop();
        if (traversal.current.t_near <= traversal.best.t) return true;
    }
    return false;
}

// The whole traversal of a ray that has been started, with the tree's width known to the compiler.
template <std::uint32_t Width>
void run(Traversal& traversal, const MemoryImage& image, TraversalCounts& counts) {
    do {
        const NodeRef ref = traversal.current.ref;
        if (ref.is_leaf()) {
            for (std::uint32_t i = 0; i < ref.pair_count() && !is_satisfied(traversal); ++i) {
                counts.triangle_tests += visit(traversal, image.leaf_pair(ref, i)).triangle_tests;
                ++counts.pair_tests;
            }
        } else {
            counts.box_tests += visit<Width>(traversal, image);
            ++counts.node_visits;
        }
    } while (!is_satisfied(traversal) && pop_relevant(traversal, 0));
}

}  // namespace

std::size_t stack_capacity(const MemoryImage& image) {
    // A visit pops one entry and pushes at most `width`.
    return std::size_t(image.width - 1) * image.depth + 1;
}

bool start(Traversal& traversal, const MemoryImage& image, const Ray& ray, RayKind kind) {
    const auto setup = make_ray_setup(ray, image.bounds);
    traversal.has_hit = false;
    traversal.best = Hit{.t = ray.t_max};
    traversal.kind = kind;
    traversal.stack.reset(stack_capacity(image));
    if (!setup) return false;
    traversal.ray = *setup;
    traversal.current = {image.root(), ray.t_min};
    return true;
}

std::uint32_t child_count(const MemoryImage& image, NodeRef ref) {
    switch (image.width) {
        case 2:
            return image.node<2>(ref).child_count;
        case 4:
            return image.node<4>(ref).child_count;
        case 6:
            return image.node<6>(ref).child_count;
        default:
            return image.node<8>(ref).child_count;
    }
}

std::uint32_t visit_node(Traversal& traversal, const MemoryImage& image) {
    switch (image.width) {
        case 2:
            return visit<2>(traversal, image);
        case 4:
            return visit<4>(traversal, image);
        case 6:
            return visit<6>(traversal, image);
        default:
            return visit<8>(traversal, image);
    }
}

PairVisit visit_pair(Traversal& traversal, const MemoryImage& image, std::uint32_t index) {
    return visit(traversal, image.leaf_pair(traversal.current.ref, index));
}

bool pop(Traversal& traversal, std::size_t floor) { return pop_relevant(traversal, floor); }

std::optional<Hit> trace(Traversal& scratch, const MemoryImage& image, const Ray& ray, RayKind kind,
                         TraversalCounts* counts) {
    TraversalCounts mine;
    if (start(scratch, image, ray, kind)) {
        switch (image.width) {
            case 2:
                run<2>(scratch, image, mine);
                break;
            case 4:
                run<4>(scratch, image, mine);
                break;
            case 6:
                run<6>(scratch, image, mine);
                break;
            default:
                run<8>(scratch, image, mine);
        }
    }
    if (counts != nullptr) *counts += mine;
    return scratch.has_hit ? std::optional(scratch.best) : std::nullopt;
}

std::optional<Hit> trace(const MemoryImage& image, const Ray& ray, RayKind kind, TraversalCounts* counts) {
    Traversal scratch;
    return trace(scratch, image, ray, kind, counts);
}

}  // namespace rtu::model
