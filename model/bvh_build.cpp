#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "model/bvh.hpp"
#include "model/error.hpp"
#include "model/quantised_node.hpp"

namespace rtu::model {

namespace {

constexpr unsigned max_depth = 1024;  // of Embree's tree; far beyond what its splits can make

// What Embree's callbacks make, in memory that belongs to the RTCBVH: this header, then `count` children or
// pair indices.
struct BuildRecord {
    bool is_leaf;
    std::uint32_t count;

    [[nodiscard]] std::span<BuildRecord*> children() {
        return {reinterpret_cast<BuildRecord**>(this + 1), count};
    }
    [[nodiscard]] std::span<std::uint32_t> pairs() {
        return {reinterpret_cast<std::uint32_t*>(this + 1), count};
    }
};
static_assert(sizeof(BuildRecord) % alignof(BuildRecord*) == 0);

BuildRecord* allocate(RTCThreadLocalAllocator allocator, bool is_leaf, std::size_t count) {
    constexpr std::size_t item_bytes = sizeof(void*);  // room for either kind
    void* memory = rtcThreadLocalAlloc(allocator, sizeof(BuildRecord) + count * item_bytes, 16);
    return new (memory) BuildRecord{is_leaf, std::uint32_t(count)};
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned child_count, void*) {
    return allocate(allocator, false, child_count);
}

void set_children(void* node, void** children, unsigned child_count, void*) {
    const auto slots = static_cast<BuildRecord*>(node)->children();
    for (unsigned i = 0; i < child_count; ++i) slots[i] = static_cast<BuildRecord*>(children[i]);
}

// Boxes are gathered from the pairs when the image is written.
void set_bounds(void*, const RTCBounds**, unsigned, void*) {}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                  void*) {
    BuildRecord* leaf = allocate(allocator, true, count);
    for (std::size_t i = 0; i < count; ++i) leaf->pairs()[i] = primitives[i].primID;
    return leaf;
}

Aabb pair_box(const TrianglePair& pair, const TriangleMesh& mesh) {
    Aabb box;
    for (const std::uint32_t vertex : pair.vertices) box.extend(mesh.positions[vertex]);
    return box;
}

std::vector<RTCBuildPrimitive> build_primitives(const TriangleMesh& mesh, const Pairing& pairing) {
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(pairing.pairs.size());
    for (const TrianglePair& pair : pairing.pairs) {
        const auto [lo, hi] = pair_box(pair, mesh);
        primitives.push_back({lo.x, lo.y, lo.z, 0, hi.x, hi.y, hi.z, std::uint32_t(primitives.size())});
    }
    return primitives;
}

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseBvh {
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

// Embree's tree and the memory it lies in.
class EmbreeTree {
  public:
    EmbreeTree(std::vector<RTCBuildPrimitive> primitives, BvhOptions options)
        // One thread: the order of equal primitives after a parallel partition would depend on the thread
        // count.
        : device_(rtcNewDevice("threads=1")), bvh_(rtcNewBVH(device_.get())) {
        RTCBuildArguments arguments = rtcDefaultBuildArguments();
        arguments.maxBranchingFactor = options.width;
        arguments.maxDepth = max_depth;
        arguments.maxLeafSize = options.max_leaf_pairs;
        arguments.bvh = bvh_.get();
        arguments.primitives = primitives.data();
        arguments.primitiveCount = primitives.size();
        arguments.primitiveArrayCapacity = primitives.size();
        arguments.createNode = create_node;
        arguments.setNodeChildren = set_children;
        arguments.setNodeBounds = set_bounds;
        arguments.createLeaf = create_leaf;
        root_ = static_cast<BuildRecord*>(rtcBuildBVH(&arguments));
        RTU_CHECK(root_ != nullptr, "Embree built no BVH (error {})", int(rtcGetDeviceError(device_.get())));
    }
    [[nodiscard]] BuildRecord& root() const { return *root_; }

  private:
    std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
    std::unique_ptr<RTCBVHTy, ReleaseBvh> bvh_;
    BuildRecord* root_ = nullptr;
};

// Counts what the image must hold.
void count(BuildRecord& record, std::uint32_t level, MemoryImage& image) {
    if (record.is_leaf) {
        ++image.leaf_count;
        image.pair_count += record.count;
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
        : image_(image), mesh_(mesh), pairing_(pairing), next_leaf_(image.node_count * sizeof(Node<Width>)) {}

    Aabb write_node(std::span<BuildRecord* const> children) {
        auto& node = *new (&image_.blocks[next_node_ / image_block_bytes]) Node<Width>{};
        next_node_ += sizeof(Node<Width>);
        node.child_count = std::uint32_t(children.size());
        Aabb whole;
        for (std::uint32_t i = 0; i < Width; ++i) {
            Aabb box;
            if (i < children.size()) {
                BuildRecord& child = *children[i];
                node.child[i] =
                    child.is_leaf ? NodeRef::leaf(next_leaf_, child.count) : NodeRef::inner(next_node_);
                box = child.is_leaf ? write_leaf(child) : write_node(child.children());
            }
            node.set_box(i, box);
            whole.extend(box);
        }
        return whole;
    }

  private:
    Aabb write_leaf(BuildRecord& leaf) {
        Aabb box;
        for (const std::uint32_t index : leaf.pairs()) {
            const TrianglePair& pair = pairing_.pairs[index];
            new (&image_.blocks[next_leaf_ / image_block_bytes])
                LeafPair(make_leaf_pair(pair, mesh_.positions));
            next_leaf_ += image_block_bytes;
            box.extend(pair_box(pair, mesh_));
        }
        return box;
    }

    MemoryImage& image_;
    const TriangleMesh& mesh_;
    const Pairing& pairing_;
    std::uint64_t next_node_ = 0;
    std::uint64_t next_leaf_;
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
    if (pairing.pairs.empty()) throw Error("{}: expected triangles to build a BVH over, got none", mesh.name);

    const EmbreeTree tree(build_primitives(mesh, pairing), options);
    MemoryImage image;
    image.width = options.width;
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
