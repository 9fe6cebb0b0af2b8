#include "model/traversal.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "model/error.hpp"
#include "model/pair_test.hpp"
#include "model/quantised_node.hpp"
#include "model/slab_test.hpp"
#include "model/traversal_log.hpp"

namespace rtu::model {

namespace {

// Calls `f` with the tree's type of node.
template <template <std::uint32_t> class AnyNode, class F>
auto with_width(const MemoryImage& image, F f) {
    switch (image.width) {
        case 2:
            return f.template operator()<AnyNode<2>>();
        case 4:
            return f.template operator()<AnyNode<4>>();
        case 6:
            return f.template operator()<AnyNode<6>>();
        default:
            return f.template operator()<AnyNode<8>>();
    }
}
template <class F>
auto with_node(const MemoryImage& image, F f) {
    return image.format == NodeFormat::Full ? with_width<Node>(image, f)
                                            : with_width<QuantisedNode>(image, f);
}

template <std::uint32_t Width>
NodeRef child_of(const Node<Width>& node, std::uint32_t i) {
    return node.child[i];
}
template <std::uint32_t Width>
NodeRef child_of(const QuantisedNode<Width>& node, std::uint32_t i) {
    return node.child(i);
}

// Of the children that the ray enters, at least one, returns the nearest and pushes the others so that nearer
// ones lie higher; of equally near ones the lowest index counts as nearest.
template <class AnyNode>
[[gnu::always_inline]] inline StackEntry push_all_but_nearest(const AnyNode& node,
                                                              const SlabHits<AnyNode::width>& hits,
                                                              TraversalStack& stack) {
    const auto first_of = [&](std::uint32_t mask) {
        const auto child = std::uint32_t(std::countr_zero(mask));
        return StackEntry{child_of(node, child), hits.t_near[child]};
    };
    const std::size_t base = stack.size();
    StackEntry nearest = first_of(hits.mask);
    for (std::uint32_t mask = hits.mask & (hits.mask - 1); mask != 0; mask &= mask - 1) {
        const StackEntry entry = first_of(mask);
        if (entry.t_near < nearest.t_near) {
            stack.push(nearest);
            nearest = entry;
            continue;
        }
        std::size_t place = stack.size();
        stack.push(entry);
        for (; place > base && stack[place - 1].t_near <= entry.t_near; --place)
            stack[place] = stack[place - 1];
        stack[place] = entry;
    }
    return nearest;
}

bool is_better(const Hit& hit, const Closest& closest) {
    if (hit.t < closest.hit.t) return true;
    return closest.is_found && hit.t == closest.hit.t && hit.primitive_id < closest.hit.primitive_id;
}

PairVisit update_closest(Closest& closest, const LeafPair& pair, const RaySetup& ray) {
    const PairHits found = test_pair(pair, ray);
    PairVisit visit{pair.has_second() ? 2U : 1U, found.exact_tests, 0, found.side_tests};
    for (std::size_t i = 0; i < 2; ++i) {
        if (!found.is_pierced[i] || !is_better(found.hits[i], closest)) continue;
        closest = {found.hits[i], true};
        ++visit.better_hits;
    }
    return visit;
}

// The whole traversal of one ray, with the tree's nodes known to the compiler and the ray's constants in
// registers. The nearest child is visited next without passing through the stack. `is_passed` is asked of
// every leaf whether the ray goes on without it; `on_visit` and `on_pair` are told what is visited and
// tested.
template <class AnyNode, class IsPassed, class OnVisit, class OnPair>
Closest run(const MemoryImage& image, const RaySetup& ray, RayKind kind, TraversalStack& stack,
            TraversalCounts& counts, IsPassed is_passed, OnVisit on_visit, OnPair on_pair) {
    const SlabRay<slab_lanes<AnyNode::width>> slab_ray(ray);
    Closest closest{Hit{.t = ray.t_max}};
    StackEntry current{image.root(), ray.t_min};
    while (true) {
        on_visit(current.ref);
        if (current.ref.is_leaf() && is_passed(current.ref)) {
            ++counts.mailbox_hits;
        } else if (current.ref.is_leaf()) {
            for (std::uint32_t i = 0; i < current.ref.pair_count(); ++i) {
                const PairVisit visit = update_closest(closest, image.leaf_pair(current.ref, i), ray);
                counts.triangle_tests += visit.triangle_tests;
                ++counts.pair_tests;
                on_pair(visit);
                if (kind == RayKind::AnyHit && closest.is_found) return closest;
            }
        } else {
            const AnyNode& node = image.node_as<AnyNode>(current.ref);
            const SlabHits<AnyNode::width> hits = slab_test(node, slab_ray, closest.hit.t);
            counts.box_tests += node.child_count;
            ++counts.node_visits;
            if (hits.mask != 0) {
                current = push_all_but_nearest(node, hits, stack);
                continue;
            }
        }
        do {
            if (stack.size() == 0) return closest;
            current = stack.pop();
        } while (current.t_near > closest.hit.t);
    }
}

// Traces the ray past the leaves of which `is_passed` says so.
template <class IsPassed>
std::optional<Hit> trace_past(TraversalStack& stack, const MemoryImage& image, const Ray& ray, RayKind kind,
                              TraversalCounts* counts, IsPassed is_passed) {
    if (!can_hit(ray)) return std::nullopt;
    stack.reset(stack_capacity(image));
    TraversalCounts mine;
    const RaySetup setup = make_ray_setup(ray, image.bounds);
    const Closest closest = with_node(image, [&]<class AnyNode>() {
        return run<AnyNode>(
            image, setup, kind, stack, mine, [&](NodeRef leaf) { return is_passed(leaf, mine); },
            [](NodeRef) {}, [](const PairVisit&) {});
    });
    if (counts != nullptr) *counts += mine;
    return closest.is_found ? std::optional(closest.hit) : std::nullopt;
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
    return with_node(image,
                     [&]<class AnyNode>() { return std::uint32_t(image.node_as<AnyNode>(ref).child_count); });
}

NodeVisit visit_node(Traversal& traversal, const MemoryImage& image) {
    return with_node(image, [&]<class AnyNode>() {
        constexpr std::uint32_t width = AnyNode::width;
        const NodeRef ref = traversal.current.ref;
        const AnyNode& node = image.node_as<AnyNode>(ref);
        const SlabRay<slab_lanes<width>> ray(traversal.ray);
        const SlabHits<width> hits = slab_test(node, ray, traversal.closest.hit.t);
        if (hits.mask != 0) traversal.stack.push(push_all_but_nearest(node, hits, traversal.stack));
        NodeVisit visit{node.child_count, std::uint32_t(std::popcount(hits.mask)), 0};
        if constexpr (AnyNode::format == NodeFormat::Quantised) {
            const auto exact = slab_test(image.exact_node<width>(ref), ray, traversal.closest.hit.t);
            visit.extra_hits = std::uint32_t(std::popcount(hits.mask & ~exact.mask));
        }
        return visit;
    });
}

PairVisit visit_pair(Traversal& traversal, const MemoryImage& image, std::uint32_t index) {
    return update_closest(traversal.closest, image.leaf_pair(traversal.current.ref, index), traversal.ray);
}

PairVisit visit_pair(Closest& closest, const LeafPair& pair, const RaySetup& ray) {
    return update_closest(closest, pair, ray);
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
    return trace_past(stack, image, ray, kind, counts, [](NodeRef, TraversalCounts&) { return false; });
}

std::optional<Hit> trace(TraversalStack& stack, Mailbox& mailbox, const MemoryImage& image, const Ray& ray,
                         RayKind kind, TraversalCounts* counts) {
    mailbox.clear(image.has_shared_pairs());
    return trace_past(stack, image, ray, kind, counts, [&](NodeRef leaf, TraversalCounts& mine) {
        const MailboxAnswer answer = mailbox.look_up(leaf);
        mine.duplicate_tests += answer == MailboxAnswer::Again ? 1 : 0;
        return answer == MailboxAnswer::Known;
    });
}

std::optional<Hit> trace(const MemoryImage& image, const Ray& ray, RayKind kind, TraversalCounts* counts) {
    TraversalStack stack;
    return trace(stack, image, ray, kind, counts);
}

void trace(TraversalStack& stack, const MemoryImage& image, const Ray& ray, RayKind kind, TraversalLog& log) {
    log.visits.clear();
    log = {.visits = std::move(log.visits), .pairs = {}};
    if (!can_hit(ray)) return;
    stack.reset(stack_capacity(image));
    const RaySetup setup = make_ray_setup(ray, image.bounds);
    const auto on_pair = [&log](const PairVisit& visit) {
        log.survivor_pairs += visit.exact_tests > 0 ? 1 : 0;
        log.pairs.triangle_tests += visit.triangle_tests;
        log.pairs.exact_tests += visit.exact_tests;
        log.pairs.better_hits += visit.better_hits;
        log.pairs.side_tests += visit.side_tests;
    };
    const auto on_visit = [&log](NodeRef ref) {
        log.visits.push_back(ref);
        log.leaf_visits += ref.is_leaf() ? 1 : 0;
    };
    TraversalCounts counts;
    with_node(image, [&]<class AnyNode>() {
        return run<AnyNode>(
            image, setup, kind, stack, counts, [](NodeRef) { return false; }, on_visit, on_pair);
    });
    log.node_visits = std::uint32_t(counts.node_visits);
    log.box_tests = std::uint32_t(counts.box_tests);
    log.pair_tests = std::uint32_t(counts.pair_tests);
}

}  // namespace rtu::model
