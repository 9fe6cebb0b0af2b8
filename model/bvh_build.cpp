#include <algorithm>
#include <cstdint>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "model/bvh.hpp"
#include "model/bvh_tree.hpp"
#include "model/error.hpp"
#include "model/quantised_node.hpp"

namespace rtu::model {

namespace {

// Counts what the image must hold.
void count(BuildRecord& record, std::uint32_t level, MemoryImage& image) {
    if (record.is_leaf) {
        ++image.leaf_count;
        image.reference_count += record.count;
        return;
    }
    ++image.node_count;
    image.depth = std::max(image.depth, level);
    for (BuildRecord* child : record.children()) count(*child, level + 1, image);
}

// Writes the tree depth first: addresses in the order of the walk, a node's boxes once its children are
// known.
template <std::uint32_t Width>
class ImageWriter {
  public:
    ImageWriter(MemoryImage& image, const TriangleMesh& mesh, const Pairing& pairing)
        : image_(image),
          mesh_(mesh),
          pairing_(pairing),
          next_pair_(image.node_count * sizeof(Node<Width>)),
          addresses_(pairing.pairs.size()) {}

    Aabb write_node(std::span<BuildRecord* const> children) {
        auto& node = *new (&image_.blocks[next_node_ / image_block_bytes]) Node<Width>{};
        next_node_ += sizeof(Node<Width>);
        node.child_count = std::uint32_t(children.size());
        Aabb whole;
        for (std::uint32_t i = 0; i < Width; ++i) {
            Aabb box;
            if (i < children.size()) {
                BuildRecord& child = *children[i];
                if (child.is_leaf) {
                    node.child[i] = write_leaf(child);
                    for (const BuildReference& reference : child.references()) box.extend(reference.box);
                } else {
                    node.child[i] = NodeRef::inner(next_node_);
                    box = write_node(child.children());
                }
            }
            node.set_box(i, box);
            whole.extend(box);
        }
        return whole;
    }

  private:
    // The pairs of a leaf lie one after another; one that is alone in its leaves is written for the first.
    NodeRef write_leaf(BuildRecord& leaf) {
        std::optional<std::uint64_t> first;
        for (const BuildReference& reference : leaf.references()) {
            std::optional<std::uint64_t>& address = addresses_[reference.pair];
            if (!address) address = write_pair(pairing_.pairs[reference.pair]);
            if (!first) first = address;
        }
        return NodeRef::leaf(*first, leaf.count);
    }

    std::uint64_t write_pair(const TrianglePair& pair) {
        const std::uint64_t address = next_pair_;
        new (&image_.blocks[address / image_block_bytes]) LeafPair(make_leaf_pair(pair, mesh_.positions));
        next_pair_ += image_block_bytes;
        return address;
    }

    MemoryImage& image_;
    const TriangleMesh& mesh_;
    const Pairing& pairing_;
    std::uint64_t next_node_ = 0;
    std::uint64_t next_pair_;
    std::vector<std::optional<std::uint64_t>> addresses_;  // of the pairs that are written
};

template <std::uint32_t Width>
Aabb write_image(MemoryImage& image, const TriangleMesh& mesh, const Pairing& pairing, BuildRecord& root) {
    BuildRecord* const lone_leaf[] = {&root};
    return ImageWriter<Width>(image, mesh, pairing)
        .write_node(root.is_leaf ? std::span<BuildRecord* const>(lone_leaf) : root.children());
}

}  // namespace

MemoryImage build_bvh(const TriangleMesh& mesh, const Pairing& pairing, BvhOptions options) {
    RTU_CHECK(options.width == 2 || options.width == 4 || options.width == 6 || options.width == 8,
              "BVH width {} is not 2, 4, 6 or 8", options.width);
    RTU_CHECK(options.max_leaf_pairs >= 1 && options.max_leaf_pairs <= max_leaf_pairs,
              "{} pairs a leaf are not 1 to {}", options.max_leaf_pairs, max_leaf_pairs);
    RTU_CHECK(options.splits == SplitKind::Object || options.max_leaf_pairs == 1,
              "{} pairs a leaf are not 1, as spatial splits need", options.max_leaf_pairs);
    RTU_CHECK(options.splits == SplitKind::Object || options.builder == BvhBuilder::Sah,
              "the builder is not the one that can split a pair");
    // A quantised node's leaves lie side by side, so none can be another node's too.
    RTU_CHECK(options.splits == SplitKind::Object || options.node_format == NodeFormat::Full,
              "nodes are quantised, and leaves of spatial splits are shared");
    if (pairing.pairs.empty()) throw Error("{}: expected triangles to build a BVH over, got none", mesh.name);

    const EmbreeTree tree(mesh, pairing, options);
    MemoryImage image;
    image.width = options.width;
    image.pair_count = pairing.pairs.size();
    count(tree.root(), 1, image);
    if (tree.root().is_leaf) image.node_count = image.depth = 1;  // the root is always an inner node

    const std::uint64_t bytes = image.node_count * image.node_bytes() + image.pair_count * image_block_bytes;
    if (bytes > max_image_bytes) {
        throw Error("{}: expected an image of at most {} bytes, got {}", mesh.name, max_image_bytes, bytes);
    }
    image.blocks.resize(bytes / image_block_bytes);
    switch (image.width) {
        case 2:
            image.bounds = write_image<2>(image, mesh, pairing, tree.root());
            break;
        case 4:
            image.bounds = write_image<4>(image, mesh, pairing, tree.root());
            break;
        case 6:
            image.bounds = write_image<6>(image, mesh, pairing, tree.root());
            break;
        default:
            image.bounds = write_image<8>(image, mesh, pairing, tree.root());
    }
    return options.node_format == NodeFormat::Full ? image : quantise_nodes(image);
}

}  // namespace rtu::model
