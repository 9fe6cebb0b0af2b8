#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "model/camera.hpp"
#include "model/sampling.hpp"
#include "model/surface.hpp"
#include "model/traversal.hpp"

// A room is a scene from whose box most rays, from anywhere in it and in any direction, meet the front of a
// surface (counter-clockwise corners, as glTF defines it). Measured: conference, kitchen, sponza and a
// Cornell box 0.70 to 0.95; cars, products, statues and open courtyards at most 0.40. A closed solid fails
// because its inside shows backs.

namespace rtu::model {
namespace {

constexpr std::uint64_t seed = 0;  // the camera stays where it is when the rays' seed changes
constexpr std::uint32_t purpose = 100;
constexpr std::uint32_t eye_count = 256;
constexpr std::uint32_t looks_per_eye = 128;
constexpr std::uint32_t landmark_count = 256;
constexpr std::uint32_t subject_corner_count = 4096;
constexpr float room_share = 0.55F;
constexpr float outside_tan_half_fov = 0.4F;
constexpr float inside_tan_half_fov = 0.8F;

// Places in the box from which to look, and every n-th corner to look at: where the detail
// is.
struct Survey {
    const TriangleMesh& mesh;
    const MemoryImage& image;
    std::vector<Vec3> eyes;
    std::vector<Vec3> landmarks;
};

std::vector<Vec3> sample_corners(const TriangleMesh& mesh, std::size_t count) {
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t corner = i * (3 * mesh.triangles.size()) / count;
        corners.push_back(mesh.positions[mesh.triangles[corner / 3][corner % 3]]);
    }
    return corners;
}

bool sees_front(const Survey& survey, Vec3 eye, Vec3 direction) {
    const Ray ray{eye, 0, direction, std::numeric_limits<float>::infinity()};
    const std::optional<Hit> hit = trace(survey.image, ray, RayKind::ClosestHit);
    if (!hit) return false;
    const std::optional<Vec3> normal = geometric_normal(survey.mesh, hit->primitive_id);
    return normal && dot(*normal, direction) < 0;
}

bool is_room(const Survey& survey) {
    std::uint32_t front_count = 0;
    for (std::uint32_t i = 0; i < eye_count; ++i) {
        RandomStream random(seed, purpose + 1, i);
        for (std::uint32_t look = 0; look < looks_per_eye; ++look) {
            front_count += sees_front(survey, survey.eyes[i], sample_sphere(random)) ? 1U : 0U;
        }
    }
    return float(front_count) > room_share * float(eye_count * looks_per_eye);
}

// A landmark in sight: which way, and how much it counts. Far ones count more, by the square root of the
// distance: the view takes in a hall with what is in it rather than one busy thing from close by.
struct Sight {
    Vec3 direction;
    float weight = 0;
};

std::vector<Sight> sights_from(const Survey& survey, Vec3 eye) {
    std::vector<Sight> sights;
    for (const Vec3 landmark : survey.landmarks) {
        const std::optional<Vec3> direction = direction_between(eye, landmark);
        if (!direction) continue;
        const float distance = distance_between(eye, landmark);
        const Ray ray{eye, 0, *direction, distance * (1 - 0x1p-10F)};
        if (!trace(survey.image, ray, RayKind::AnyHit)) sights.push_back({*direction, std::sqrt(distance)});
    }
    return sights;
}

float score(const std::vector<Sight>& sights, Vec3 forward) {
    float sum = 0;
    for (const Sight& sight : sights) sum += dot(sight.direction, forward) > 0.75F ? sight.weight : 0.0F;
    return sum;
}

// Share of the picture that shows something: a view out of a window or a missing wall shows little.
float covered_share(const MemoryImage& image, const Camera& camera) {
    constexpr std::uint32_t side = 5;
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const Ray ray = camera_ray(camera, {side, side}, i % side, i / side);
        count += trace(image, ray, RayKind::AnyHit) ? 1U : 0U;
    }
    return float(count) / float(side * side);
}

Camera inside_camera(const Survey& survey) {
    // Sixteen ways to look, a little down, as people do; from the middle heights of the room.
    constexpr std::array<std::array<float, 2>, 4> quadrant{
        {{1, 0}, {0.924F, 0.383F}, {0.707F, 0.707F}, {0.383F, 0.924F}}};
    const Aabb& box = survey.image.bounds;
    const float reach = 0.25F * distance_between(box.lo, box.hi);
    Camera best;
    float best_value = -1;
    for (const Vec3 eye : survey.eyes) {
        const float height = (eye.y - box.lo.y) / (box.hi.y - box.lo.y);
        if (!(height > 0.25F && height < 0.75F)) continue;
        const std::vector<Sight> sights = sights_from(survey, eye);
        for (const auto& [a, b] : quadrant) {
            for (const Vec3 way : {Vec3{a, 0, b}, Vec3{-b, 0, a}, Vec3{-a, 0, -b}, Vec3{b, 0, -a}}) {
                const Vec3 forward = normalized(way + Vec3{0, -0.1F, 0});
                const Camera camera{eye, eye + forward * reach, Vec3{0, 1, 0}, inside_tan_half_fov};
                const float bound = score(sights, forward);
                if (!(bound > best_value)) continue;
                const float value = bound * covered_share(survey.image, camera);
                if (!(value > best_value)) continue;
                best_value = value;
                best = camera;
            }
        }
    }
    return best;
}

// The box of most of the corners: per axis from the 2nd to the 98th percentile, a quarter wider, within the
// scene's box. A backdrop or a ground plane of few triangles does not shrink the object before it.
Aabb subject_box(const std::vector<Vec3>& corners, const Aabb& bounds) {
    const std::size_t cut = corners.size() / 50;
    Aabb box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<float> places;
        places.reserve(corners.size());
        for (const Vec3 corner : corners) places.push_back(corner[axis]);
        std::sort(places.begin(), places.end());
        const float low = places[cut];
        const float high = places[places.size() - 1 - cut];
        const float margin = (high - low) * 0.125F;
        box.lo[axis] = std::max(low - margin, bounds.lo[axis]);
        box.hi[axis] = std::min(high + margin, bounds.hi[axis]);
    }
    return distance_between(box.lo, box.hi) > 0 ? box : bounds;  // nearly all corners in one place
}

// From the front, the right and above, as near as the subject can be seen in a square picture.
Camera outside_camera(const TriangleMesh& mesh, const Aabb& bounds) {
    const std::vector<Vec3> corners = sample_corners(mesh, subject_corner_count);
    const Aabb box = subject_box(corners, bounds);
    const Vec3 centre = point_in_box(box, {0.5F, 0.5F, 0.5F});
    const Vec3 back = normalized(Vec3{0.45F, 0.35F, 1});
    const Vec3 right = normalized(cross(Vec3{0, 1, 0}, back));
    const Vec3 up = cross(back, right);
    float distance = 0.1F * distance_between(box.lo, box.hi);
    for (const Vec3 corner : corners) {
        if (!box.contains(corner)) continue;
        const Vec3 p = corner - centre;
        const float sideways = std::max(std::abs(dot(p, right)), std::abs(dot(p, up)));
        distance = std::max(distance, sideways / outside_tan_half_fov + dot(p, back));
    }
    return {centre + back * (1.08F * distance), centre, Vec3{0, 1, 0}, outside_tan_half_fov};
}

}  // namespace

Camera automatic_camera(const TriangleMesh& mesh, const MemoryImage& image) {
    Survey survey{mesh, image, {}, sample_corners(mesh, landmark_count)};
    for (std::uint32_t i = 0; i < eye_count; ++i) {
        RandomStream random(seed, purpose, i);
        survey.eyes.push_back(sample_box(random, image.bounds));
    }
    return is_room(survey) ? inside_camera(survey) : outside_camera(mesh, image.bounds);
}

}  // namespace rtu::model
