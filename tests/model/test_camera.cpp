#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "meshes.hpp"
#include "model/camera.hpp"
#include "model/error.hpp"
#include "model/gltf.hpp"
#include "model/traversal.hpp"
#include "tests/scenes.hpp"

namespace rtu::model {
namespace {

using test::closed_box;
using test::closed_sphere;
using test::image_of;
using testing::HasSubstr;

// A camera file that lives as long as the test.
class CameraFile : public testing::Test {
  protected:
    CameraFile()
        : path_(testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() +
                ".toml") {}
    ~CameraFile() override { std::filesystem::remove(path_); }

    std::optional<Camera> load(const std::string& text, std::string_view scene = "room") {
        std::ofstream(path_) << text;
        return load_camera(path_, scene);
    }
    std::string error(const std::string& text) {
        try {
            static_cast<void>(load(text));
        } catch (const Error& e) {
            return e.what();
        }
        return "no error";
    }
    // What errors about line `line` start with.
    std::string at(int line) { return path_ + ":" + std::to_string(line) + ": "; }

    std::string path_;
};

constexpr const char* good = "eye = [1, 2.5, 3]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\ntan_half_fov = 0.75\n";

TEST_F(CameraFile, ReadsTheTableOfTheScene) {
    const auto camera =
        load(std::string("[other]\n") + good + "[room]\neye = [9, 8, 7]\ntarget = [1, 1, 1]\n" +
             "up = [0, 0, 1]\ntan_half_fov = 2\n");
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->eye, (Vec3{9, 8, 7}));
    EXPECT_EQ(camera->target, (Vec3{1, 1, 1}));
    EXPECT_EQ(camera->up, (Vec3{0, 0, 1}));
    EXPECT_EQ(camera->tan_half_fov, 2.0F);
}

TEST_F(CameraFile, HasNothingForASceneWithoutATable) {
    EXPECT_FALSE(load(std::string("[other]\n") + good));
    EXPECT_THAT(error(""), HasSubstr("without the key"));  // not even another scene's: a mistake
}

TEST_F(CameraFile, KeysAtTheTopServeEveryScene) {
    const auto camera = load(good, "anything");
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->eye, (Vec3{1, 2.5F, 3}));
}

TEST_F(CameraFile, NamesFileAndLineOfWhatIsWrong) {
    const std::string table = "[room]\n";
    EXPECT_THAT(error("eye = [1, 2\n"), HasSubstr(path_ + ":"));
    EXPECT_THAT(error(table + "eye = [1, 2]\n"), HasSubstr(at(2) + "eye: expected three"));
    EXPECT_THAT(error(table + "eye = [1, 2, \"x\"]\n"), HasSubstr(at(2) + "eye: expected three"));
    EXPECT_THAT(error(table + "eye = [1, 2, nan]\n"), HasSubstr(at(2) + "eye: expected three"));
    EXPECT_THAT(error(table + "eye = [1, 2, 1e300]\n"), HasSubstr(at(2) + "eye: expected three"));
    EXPECT_THAT(error(table + "eye = [1, 2, -1.1e11]\n"), HasSubstr(at(2) + "eye: expected coordinates of"));
    EXPECT_THAT(error(table + "target = [1.1e11, 2, 3]\n"), HasSubstr(at(2) + "target: expected coord"));
    EXPECT_THAT(error(table + "fov = 60\n"),
                HasSubstr(at(2) + "expected eye, target, up or tan_half_fov, got 'fov'"));
    EXPECT_THAT(error(table + "eye = [1, 2, 3]\n"), HasSubstr("without the key"));
    EXPECT_THAT(error(std::string(good) + "[room]\n" + good), HasSubstr("expected tables only"));
    for (const char* fov : {"0", "-1", "100.5", "inf", "nan", "'wide'"}) {
        EXPECT_THAT(error(std::string("eye=[0,0,1]\ntarget=[0,0,0]\nup=[0,1,0]\ntan_half_fov=") + fov),
                    HasSubstr(at(4) + "tan_half_fov: expected"))
            << fov;
    }
}

TEST_F(CameraFile, ASlipInAnotherScenesTableIsReportedToo) {
    EXPECT_THAT(error(std::string("[room]\n") + good + "[other]\neye = 1\n"), HasSubstr(at(7) + "eye"));
}

TEST_F(CameraFile, RefusesACameraThatSeesNothing) {
    const auto view = [](const char* target, const char* up) {
        return std::string("eye = [1, 1, 1]\ntan_half_fov = 1\ntarget = ") + target + "\nup = " + up + "\n";
    };
    EXPECT_THAT(error(view("[1, 1, 1]", "[0, 1, 0]")), HasSubstr("same point"));
    EXPECT_THAT(error(view("[1, 5, 1]", "[0, 1, 0]")), HasSubstr("up"));
    EXPECT_THAT(error(view("[1, -5, 1]", "[0, 3, 0]")), HasSubstr("up"));
    EXPECT_THAT(error(view("[2, 1, 1]", "[0, 0, 0]")), HasSubstr("up"));
    EXPECT_EQ(error(view("[2, 1, 1]", "[0, 1e-30, 0]")), "no error");
}

TEST_F(CameraFile, MissingFileIsAnError) {
    EXPECT_THROW(static_cast<void>(load_camera("no-such-camera.toml", "room")), Error);
    EXPECT_THROW(static_cast<void>(load_camera(testing::TempDir(), "room")), Error);
}

TEST(CameraRay, PassesThroughThePixelsCentre) {
    const Camera camera{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1.0F};
    const Resolution picture{4, 2};
    const auto slope = [&](std::uint32_t x, std::uint32_t y) {
        const Ray ray = camera_ray(camera, picture, x, y);
        EXPECT_EQ(ray.origin, camera.eye);
        EXPECT_NEAR(length(ray.direction), 1.0F, 1e-6F);
        return std::array{ray.direction.x / -ray.direction.z, ray.direction.y / -ray.direction.z};
    };
    // Twice as wide as high: the left and right edges lie at slope 2, the upper and lower at 1.
    EXPECT_FLOAT_EQ(slope(0, 0)[0], -1.5F);
    EXPECT_FLOAT_EQ(slope(0, 0)[1], 0.5F);
    EXPECT_FLOAT_EQ(slope(3, 1)[0], 1.5F);
    EXPECT_FLOAT_EQ(slope(3, 1)[1], -0.5F);
    EXPECT_FLOAT_EQ(slope(2, 0)[0], 0.5F);
}

TEST(CameraRay, OnePixelLooksAtTheTarget) {
    const Camera camera{{3, 2, 1}, {-1, 5, 0}, {0, 1, 0}, 0.3F};
    const Vec3 direction = camera_ray(camera, {1, 1}, 0, 0).direction;
    EXPECT_LT(length(direction - normalized(camera.target - camera.eye)), 1e-6F);
}

double hit_share(const MemoryImage& image, const Camera& camera) {
    constexpr std::uint32_t side = 64;
    double hits = 0;
    for (std::uint32_t pixel = 0; pixel < side * side; ++pixel) {
        const Ray ray = camera_ray(camera, {side, side}, pixel % side, pixel / side);
        hits += trace(image, ray, RayKind::ClosestHit) ? 1 : 0;
    }
    return hits / (side * side);
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
    for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    return mesh;
}

TEST(AutomaticCamera, StandsInsideARoom) {
    const TriangleMesh room = turned_inside_out(closed_box(4, {0, 0, 0}, {6, 3, 9}));
    const MemoryImage image = image_of(room);
    const Camera camera = automatic_camera(room, image);
    EXPECT_TRUE(image.bounds.contains(camera.eye));
    EXPECT_EQ(hit_share(image, camera), 1.0);
}

TEST(AutomaticCamera, ShowsTheWholeOfAnObject) {
    for (const TriangleMesh& object :
         {closed_sphere(16, {5, -3, 100}, 2), closed_box(4, {0, 0, 0}, {6, 3, 9}),
          closed_box(4, {0, 0, 0}, {1, 50, 1})}) {
        const MemoryImage image = image_of(object);
        const Camera camera = automatic_camera(object, image);
        EXPECT_FALSE(image.bounds.contains(camera.eye));
        const Vec3 forward = normalized(camera.target - camera.eye);
        const Vec3 right = normalized(cross(forward, camera.up));
        const Vec3 up = cross(right, forward);
        float reach = 0;  // of the vertex farthest from the picture's middle; 1 = at its edge
        for (const Vec3 p : object.positions) {
            const Vec3 to = p - camera.eye;
            const float depth = dot(to, forward) * camera.tan_half_fov;
            reach = std::max({reach, std::abs(dot(to, right)) / depth, std::abs(dot(to, up)) / depth});
        }
        EXPECT_LT(reach, 1.0F);
        EXPECT_GT(reach, 0.6F);
    }
}

TEST(AutomaticCamera, ABackdropDoesNotShrinkTheObject) {
    TriangleMesh mesh = closed_sphere(24, {0, 1, 0}, 1);
    const auto first = std::uint32_t(mesh.positions.size());
    for (const float x : {-500.0F, 500.0F}) {
        for (const float z : {-500.0F, 500.0F}) mesh.positions.push_back({x, 0, z});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    const MemoryImage image = image_of(mesh);
    const Camera camera = automatic_camera(mesh, image);
    EXPECT_LT(length(camera.eye - camera.target), 10.0F);
}

TEST(AutomaticCamera, TellsRoomsFromObjectsInRealScenes) {
    struct Case {
        const char* file;
        bool is_room;
    };
    for (const auto& [file, is_room] :
         {Case{"conference.glb", true}, Case{"sponza.glb", true}, Case{"cornell_dragon.glb", true},
          Case{"bunny.glb", false}, Case{"legocar.glb", false}}) {
        const auto path = test::scene_file(file);
        if (!path) GTEST_SKIP() << "no real scenes here: set RTUSIM_SCENES to their folder";
        const TriangleMesh mesh = load_gltf(*path);
        const MemoryImage image = image_of(mesh);
        const Camera camera = automatic_camera(mesh, image);
        EXPECT_EQ(image.bounds.contains(camera.eye) && hit_share(image, camera) > 0.9, is_room) << file;
        EXPECT_GT(hit_share(image, camera), 0.1) << file;
    }
}

}  // namespace
}  // namespace rtu::model
