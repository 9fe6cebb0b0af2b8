#include "model/all_hits.hpp"

#include <algorithm>

#include "model/pair_test.hpp"
#include "model/traversal.hpp"

namespace rtu::model {

namespace {

void report(AllHits& all, const Hit& hit, DuplicateRule rule) {
    const bool is_duplicate =
        std::ranges::find(all.hits, hit.primitive_id, &Hit::primitive_id) != all.hits.end();
    if (is_duplicate && rule == DuplicateRule::Forbidden) return;
    all.duplicates += is_duplicate ? 1 : 0;
    all.hits.push_back(hit);
}

void test_leaf(AllHits& all, const MemoryImage& image, const Traversal& traversal, const Ray& ray,
               DuplicateRule rule) {
    const NodeRef leaf = traversal.current.ref;
    for (std::uint32_t i = 0; i < leaf.pair_count(); ++i) {
        ++all.pair_tests;
        const PairHits found = test_pair(image.leaf_pair(leaf, i), traversal.ray);
        for (std::size_t k = 0; k < 2; ++k) {
            const Hit& hit = found.hits[k];
            if (found.is_pierced[k] && hit.t > ray.t_min && hit.t < ray.t_max) report(all, hit, rule);
        }
    }
}

}  // namespace

AllHits find_all_hits(const MemoryImage& image, const Ray& ray, MailboxOptions options, DuplicateRule rule) {
    AllHits all;
    Traversal traversal;
    Mailbox mailbox(options);
    mailbox.clear(image.has_shared_pairs());
    // Without a closest hit t_end stays t_max.
    for (bool is_under_way = start(traversal, image, ray, RayKind::ClosestHit); is_under_way;
         is_under_way = pop(traversal)) {
        if (!traversal.current.ref.is_leaf()) {
            visit_node(traversal, image);
        } else if (mailbox.look_up(traversal.current.ref) != MailboxAnswer::Known) {
            test_leaf(all, image, traversal, ray, rule);
        }
    }
    return all;
}

}  // namespace rtu::model
