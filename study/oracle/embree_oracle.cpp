#include "study/oracle/embree_oracle.hpp"

#include <embree3/rtcore.h>

#include <cstring>

#include "model/error.hpp"

namespace rtu::study {

namespace {

RTCRay to_embree(const model::Ray& ray) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.tnear = ray.t_min;
    result.dir_x = ray.direction.x;
    result.dir_y = ray.direction.y;
    result.dir_z = ray.direction.z;
    result.tfar = ray.t_max;
    result.mask = ~0U;
    return result;
}

template <class T>
void copy_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& items) {
    void* target = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), items.size());
    RTU_CHECK(target != nullptr, "Embree made no buffer of {} items", items.size());
    std::memcpy(target, items.data(), items.size() * sizeof(T));
}

// A query's context with the place for its hits; Embree hands it to the filter as the first member's address.
struct Collection {
    RTCIntersectContext context;
    std::vector<model::Hit>* hits;
};

void collect(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] != -1) return;
    arguments->valid[0] = 0;  // refused: look for more
    const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
    reinterpret_cast<const Collection*>(arguments->context)
        ->hits->push_back({ray.tfar, hit.u, hit.v, hit.primID});
}

}  // namespace

EmbreeOracle::EmbreeOracle(const model::TriangleMesh& mesh, EmbreeMode mode, bool has_all_hits)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    const RTCSceneFlags robust = mode == EmbreeMode::Robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
    const RTCSceneFlags filter = has_all_hits ? RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION : RTC_SCENE_FLAG_NONE;
    rtcSetSceneFlags(scene_, RTCSceneFlags(robust | filter));
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    copy_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.positions);
    copy_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
}

EmbreeOracle::~EmbreeOracle() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

std::vector<model::Hit> EmbreeOracle::all_hits(const model::Ray& ray) const {
    std::vector<model::Hit> hits;
    Collection collection{};
    rtcInitIntersectContext(&collection.context);
    collection.context.filter = collect;
    collection.hits = &hits;
    RTCRayHit query{};
    query.ray = to_embree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &collection.context, &query);
    return hits;
}

std::optional<model::Hit> EmbreeOracle::trace(const model::Ray& ray, model::RayKind kind) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (kind == model::RayKind::AnyHit) {
        RTCRay query = to_embree(ray);
        rtcOccluded1(scene_, &context, &query);
        return query.tfar < 0 ? std::optional(model::Hit{}) : std::nullopt;
    }
    RTCRayHit query{};
    query.ray = to_embree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return model::Hit{query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID};
}

}  // namespace rtu::study
