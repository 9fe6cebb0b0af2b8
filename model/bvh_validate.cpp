#include <algorithm>
#include <utility>
#include <vector>

#include "model/bvh.hpp"
#include "model/bvh_coverage.hpp"
#include "model/error.hpp"

namespace rtu::model {

namespace {

// The file corners of a stored triangle, by position.
std::array<Vec3, 3> file_corners(const LeafPair& pair, std::uint32_t triangle) {
    const auto& v = pair.vertices;
    const std::array<Vec3, 3> stored =
        triangle == 0 ? std::array{v[0], v[1], v[2]} : std::array{v[0], v[2], v[3]};
    const CornerOrder order = pair.corner_order(triangle);
    return {stored[order.stored_corner(0)], stored[order.stored_corner(1)], stored[order.stored_corner(2)]};
}

template <std::uint32_t Width>
class Validator {
  public:
    Validator(const MemoryImage& image, const TriangleMesh& mesh)
        : image_(image), mesh_(mesh), is_seen_(mesh.triangles.size(), false) {}

    void run() {
        check_node(image_.root(), image_.bounds);
        check_shared_pairs();
        for (std::size_t i = 0; i < is_seen_.size(); ++i) {
            RTU_CHECK(is_seen_[i], "triangle {} is in no leaf", i);
        }
        RTU_CHECK(nodes_ == image_.node_count && pairs_ == image_.pair_count &&
                      references_ == image_.reference_count && leaves_ == image_.leaf_count,
                  "the image holds {} nodes, {} pairs, {} references and {} leaves, the tree reaches {}, {}, "
                  "{} and {}",
                  image_.node_count, image_.pair_count, image_.reference_count, image_.leaf_count, nodes_,
                  pairs_, references_, leaves_);
    }

  private:
    void check_address(NodeRef ref, std::uint64_t bytes) const {
        RTU_CHECK(ref.address() + bytes <= image_.size_bytes(),
                  "reference to address {} of an image of {} bytes", ref.address(), image_.size_bytes());
    }

    void check_node(NodeRef ref, const Aabb& parent_box) {
        check_address(ref, sizeof(Node<Width>));
        ++nodes_;
        RTU_CHECK(nodes_ <= image_.node_count, "node at address {} is reached twice", ref.address());
        const auto& node = image_.template node<Width>(ref);
        RTU_CHECK(node.child_count >= 1 && node.child_count <= Width, "node at address {} has {} children",
                  ref.address(), node.child_count);
        Aabb whole;
        for (std::uint32_t i = 0; i < node.child_count; ++i) {
            const Aabb box = node.box(i);
            if (node.child[i].is_leaf()) {
                check_leaf(node.child[i], box);
            } else {
                check_node(node.child[i], box);
            }
            whole.extend(box);
        }
        // Tight as well as enclosing: a loose box would be correct and slow, and nobody would notice.
        RTU_CHECK(whole == parent_box, "node at address {}: its children's boxes do not make its own",
                  ref.address());
    }

    void check_leaf(NodeRef ref, const Aabb& box) {
        check_address(ref, ref.pair_count() * image_block_bytes);
        ++leaves_;
        references_ += ref.pair_count();
        if (image_.has_shared_pairs()) {
            RTU_CHECK(ref.pair_count() == 1, "leaf at address {}: {} pairs in a tree that shares pairs",
                      ref.address(), ref.pair_count());
            shares_.emplace_back(ref.address(), box);
            return;
        }
        Aabb whole;
        for (std::uint32_t i = 0; i < ref.pair_count(); ++i) whole.extend(check_pair(ref, i));
        RTU_CHECK(whole == box, "leaf at address {}: its box is not that of its vertices", ref.address());
    }

    // Returns the box of its vertices.
    Aabb check_pair(NodeRef ref, std::uint32_t index) {
        const LeafPair& pair = image_.leaf_pair(ref, index);
        ++pairs_;
        for (std::uint32_t triangle = 0; triangle < (pair.has_second() ? 2U : 1U); ++triangle) {
            check_triangle(ref, pair, triangle);
        }
        Aabb box;
        for (const Vec3& v : pair.vertices) box.extend(v);
        return box;
    }

    // All leaves of a pair together.
    void check_shared_pairs() {
        std::ranges::stable_sort(shares_, {}, &std::pair<std::uint64_t, Aabb>::first);
        for (auto first = shares_.begin(); first != shares_.end();) {
            const NodeRef ref = NodeRef::leaf(first->first, 1);
            std::vector<Aabb> boxes;
            for (; first != shares_.end() && first->first == ref.address(); ++first) {
                boxes.push_back(first->second);
            }
            const Aabb whole = check_pair(ref, 0);
            RTU_CHECK(boxes.size() > 1 || boxes[0] == whole,
                      "leaf at address {}: its box is not that of its vertices", ref.address());
            RTU_CHECK(std::ranges::all_of(boxes, [&](const Aabb& box) { return whole.contains(box); }),
                      "leaf at address {}: a box is larger than its pair", ref.address());
            RTU_CHECK(is_covered(image_.leaf_pair(ref, 0), boxes),
                      "leaf at address {}: its boxes do not cover its triangles", ref.address());
        }
    }

    void check_triangle(NodeRef ref, const LeafPair& pair, std::uint32_t triangle) {
        const std::uint32_t id = pair.primitive_ids[triangle];
        RTU_CHECK(id < mesh_.triangles.size(), "leaf at address {}: triangle {} of {}", ref.address(), id,
                  mesh_.triangles.size());
        RTU_CHECK(!is_seen_[id], "leaf at address {}: triangle {} is in two leaves", ref.address(), id);
        is_seen_[id] = true;
        const auto corners = file_corners(pair, triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            RTU_CHECK(corners[k] == mesh_.positions[mesh_.triangles[id][k]],
                      "leaf at address {}: corner {} of triangle {} is not the file's", ref.address(), k, id);
        }
    }

    const MemoryImage& image_;
    const TriangleMesh& mesh_;
    std::vector<bool> is_seen_;
    std::vector<std::pair<std::uint64_t, Aabb>> shares_;  // address and box of each leaf, with spatial splits
    std::uint64_t nodes_ = 0, pairs_ = 0, references_ = 0, leaves_ = 0;
};

}  // namespace

void validate(const MemoryImage& image, const TriangleMesh& mesh) {
    switch (image.width) {
        case 2:
            Validator<2>(image, mesh).run();
            break;
        case 4:
            Validator<4>(image, mesh).run();
            break;
        case 6:
            Validator<6>(image, mesh).run();
            break;
        default:
            Validator<8>(image, mesh).run();
    }
}

}  // namespace rtu::model
