#include "model/bvh_tree.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <vector>

#include "model/bvh_split.hpp"
#include "model/error.hpp"

namespace rtu::model {

namespace {

constexpr unsigned max_depth = 1024;  // of Embree's tree; far beyond what its splits can make

// What Embree's callbacks are told.
struct Geometry {
    const TriangleMesh& mesh;
    const Pairing& pairing;
    bool is_split;
};

BuildRecord* allocate(RTCThreadLocalAllocator allocator, bool is_leaf, std::size_t item_bytes,
                      std::size_t count) {
    void* memory = rtcThreadLocalAlloc(allocator, sizeof(BuildRecord) + count * item_bytes, 16);
    return new (memory) BuildRecord{is_leaf, std::uint32_t(count)};
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned child_count, void*) {
    return allocate(allocator, false, sizeof(BuildRecord*), child_count);
}

void set_children(void* node, void** children, unsigned child_count, void*) {
    const auto slots = static_cast<BuildRecord*>(node)->children();
    for (unsigned i = 0; i < child_count; ++i) slots[i] = static_cast<BuildRecord*>(children[i]);
}

// Boxes are gathered from the references when the image is written.
void set_bounds(void*, const RTCBounds**, unsigned, void*) {}

Aabb box_of(const RTCBuildPrimitive& p) {
    return {{p.lower_x, p.lower_y, p.lower_z}, {p.upper_x, p.upper_y, p.upper_z}};
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                  void* user) {
    const auto& geometry = *static_cast<const Geometry*>(user);
    BuildRecord* leaf = allocate(allocator, true, sizeof(BuildReference), count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t index = primitives[i].primID;
        Aabb box = box_of(primitives[i]);
        if (geometry.is_split) {
            box = tightened_box(geometry.pairing.pairs[index], geometry.mesh.positions, box);
        }
        new (&leaf->references()[i]) BuildReference{box, index};
    }
    return leaf;
}

void write_bounds(RTCBounds& bounds, const Aabb& box) {
    bounds = {box.lo.x, box.lo.y, box.lo.z, 0, box.hi.x, box.hi.y, box.hi.z, 0};
}

void split_primitive(const RTCBuildPrimitive* primitive, unsigned axis, float position, RTCBounds* left,
                     RTCBounds* right, void* user) {
    const auto& [mesh, pairing, is_split] = *static_cast<const Geometry*>(user);
    const TrianglePair& pair = pairing.pairs[primitive->primID];
    const Aabb box = box_of(*primitive);
    write_bounds(*left, part_box(pair, mesh.positions, box, axis, box.lo[axis], position));
    write_bounds(*right, part_box(pair, mesh.positions, box, axis, position, box.hi[axis]));
}

std::vector<RTCBuildPrimitive> build_primitives(const TriangleMesh& mesh, const Pairing& pairing,
                                                std::size_t capacity) {
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(capacity);
    for (const TrianglePair& pair : pairing.pairs) {
        Aabb box;
        for (const std::uint32_t vertex : pair.vertices) box.extend(mesh.positions[vertex]);
        const auto& [lo, hi] = box;
        primitives.push_back({lo.x, lo.y, lo.z, 0, hi.x, hi.y, hi.z, std::uint32_t(primitives.size())});
    }
    primitives.resize(capacity);
    return primitives;
}

}  // namespace

EmbreeTree::EmbreeTree(const TriangleMesh& mesh, const Pairing& pairing, BvhOptions options)
    // One thread: the order of equal primitives after a parallel partition would depend on the thread count.
    : device_(rtcNewDevice("threads=1")), bvh_(rtcNewBVH(device_.get())) {
    Geometry geometry{mesh, pairing, options.splits == SplitKind::Spatial};
    const std::size_t count = pairing.pairs.size();
    const std::size_t extra = geometry.is_split ? (count * options.split_budget_percent + 99) / 100 : 0;
    std::vector<RTCBuildPrimitive> primitives = build_primitives(mesh, pairing, count + extra);
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.maxBranchingFactor = options.width;
    arguments.maxDepth = max_depth;
    arguments.maxLeafSize = options.max_leaf_pairs;
    arguments.bvh = bvh_.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = count;
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    arguments.userPtr = &geometry;
    if (options.builder == BvhBuilder::Morton) {
        arguments.buildQuality = RTC_BUILD_QUALITY_LOW;
        // It knows no cost by which a leaf could be better than a node: leaves are as full as may be.
        arguments.minLeafSize = options.max_leaf_pairs;
    }
    if (geometry.is_split) {
        arguments.buildQuality = RTC_BUILD_QUALITY_HIGH;
        arguments.splitPrimitive = split_primitive;
    }
    // Parts that are split off are numbered as they come, so that here the order of threads matters, too.
    tbb::task_arena one_thread(1);
    root_ = one_thread.execute([&] { return static_cast<BuildRecord*>(rtcBuildBVH(&arguments)); });
    RTU_CHECK(root_ != nullptr, "Embree built no BVH (error {})", int(rtcGetDeviceError(device_.get())));
}

}  // namespace rtu::model
