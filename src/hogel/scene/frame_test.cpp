// SPDX-License-Identifier: Apache-2.0
// A viewpoint before the hologram sees the picture of the file's camera.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hogel/error.h"
#include "hogel/scene.h"

namespace hogel {
namespace {

// Two triangles that a camera at (5, 1, 0), which looks along −x, sees at depths 2 and 6, and one behind it.
Scene before_a_camera() {
    Scene scene;
    scene.name = "room";
    for (const double x : {3.0, -1.0, 9.0}) {
        Mesh mesh;
        mesh.positions = {{x, 1, -0.25}, {x, 1, 0.25}, {x, 1.5, 0}};
        mesh.normals.assign(3, {1, 0, 0});
        mesh.triangles = {{0, 1, 2}};
        scene.meshes.push_back(mesh);
    }
    Light lamp;
    lamp.kind = Light::Kind::point;
    lamp.position = {5, 1, 0};
    lamp.intensity = {1, 1, 1};
    scene.lights = {lamp};
    SceneCamera camera;
    camera.name = "door";
    camera.position = {5, 1, 0};
    camera.right = {0, 0, -1};
    camera.up = {0, 1, 0};
    camera.angle = 2 * std::atan(0.5);
    scene.cameras = {camera};
    return scene;
}

void expect_vector_near(Vec3 a, Vec3 b) { EXPECT_LT(length(a - b), 1e-12) << a.x << ' ' << a.y << ' ' << a.z; }

TEST(Frame, of_a_camera_is_the_hologram) {
    Scene scene = before_a_camera();
    const Scene before = scene;
    const double eye = frame_scene(scene, scene.cameras[0], {.width = 0.2, .height = 0.1, .front = 0.5});
    EXPECT_NEAR(eye, 0.1, 1e-12);        // the picture's height over twice the half-angle's tangent
    ASSERT_EQ(scene.meshes.size(), 2u);  // what is behind the eye is gone
    // The line from the eye to a point passes the hologram's plane where the camera has it in its picture.
    for (std::size_t m = 0; m < 2; ++m)
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 then = before.meshes[m].positions[i] - Vec3{5, 1, 0}, now = scene.meshes[m].positions[i];
            const double on_plane = eye / (eye - now.z);
            EXPECT_NEAR(on_plane * now.x, 0.1 * -then.z / -then.x, 1e-12);
            EXPECT_NEAR(on_plane * now.y, 0.1 * then.y / -then.x, 1e-12);
        }
    // Half of the disparity is in front: 1/p = (1/2 + 1/6) / 2 is the plane's depth p = 3.
    EXPECT_NEAR(scene.meshes[0].positions[0].z, eye * (1 - 2.0 / 3), 1e-12);
    EXPECT_NEAR(scene.meshes[1].positions[0].z, eye * (1 - 6.0 / 3), 1e-12);
    expect_vector_near(scene.meshes[0].normals[0], {0, 0, 1});
    expect_vector_near(scene.lights[0].position, {0, 0, eye});
    EXPECT_NEAR(scene.lights[0].intensity.r, (eye / 3) * (eye / 3), 1e-9);
    // A surface far away that the picture does not show does not move the plane.
    Scene wide = before_a_camera();
    wide.meshes.push_back(wide.meshes[0]);
    for (Vec3& p : wide.meshes.back().positions) p = p + Vec3{-500, 400, 0};
    frame_scene(wide, wide.cameras[0], {.width = 0.2, .height = 0.1, .front = 0.5});
    expect_vector_near(wide.meshes[1].positions[1], scene.meshes[1].positions[1]);
}

TEST(Frame, cuts_off_what_reaches_behind_the_eye) {
    Scene scene = before_a_camera();
    Mesh floor;
    floor.positions = {{-5, 0.9, -1}, {-5, 0.9, 1}, {25, 0.9, 1}, {25, 0.9, -1}};
    floor.colors = {{0, 0, 0}, {0, 0, 0}, {3, 3, 3}, {3, 3, 3}};
    floor.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(floor);
    scene.cameras[0].nearest = 1;
    const double eye = frame_scene(scene, scene.cameras[0], {.width = 0.1, .height = 0.1, .front = 0.5});
    const Mesh& cut = scene.meshes.back();
    validate(scene);
    double nearest = -std::numeric_limits<double>::infinity(), area = 0;
    for (const auto& [a, b, c] : cut.triangles) {
        for (const std::uint32_t vertex : {a, b, c}) nearest = std::max(nearest, cut.positions[vertex].z);
        area += 0.5 * length(cross(cut.positions[b] - cut.positions[a], cut.positions[c] - cut.positions[a]));
    }
    const double scale = length(cut.positions[1] - cut.positions[0]) / 2;
    EXPECT_NEAR(nearest, eye - scale * 1, 1e-12);
    EXPECT_NEAR(area, 2 * 9 * scale * scale, 1e-12);  // of 30 metres 9 remain
    for (std::size_t i = 4; i < cut.positions.size(); ++i) EXPECT_NEAR(cut.colors[i].r, 0.9, 1e-6);
}

TEST(Frame, of_parallel_rays_divides_the_depth_itself) {
    Scene scene = before_a_camera();
    scene.cameras[0].angle = 0;
    scene.cameras[0].height = 2;
    const double eye = frame_scene(scene, scene.cameras[0], {.width = 0.1, .height = 0.1, .front = 0.25});
    EXPECT_EQ(eye, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(scene.meshes[0].positions[0].z, 0.05 * 1, 1e-12);
    EXPECT_NEAR(scene.meshes[1].positions[0].z, 0.05 * -3, 1e-12);
    EXPECT_NEAR(scene.meshes[1].positions[2].y, 0.05 * 0.5, 1e-12);
}

TEST(Frame, needs_a_camera_that_there_is_and_that_sees_something) {
    Scene scene = before_a_camera();
    EXPECT_EQ(find_camera(scene, "door").name, "door");
    EXPECT_EQ(find_camera(scene, "1").name, "door");
    for (const char* wrong : {"2", "0", "window", ""}) EXPECT_THROW(find_camera(scene, wrong), Error) << wrong;
    scene.cameras[0].right = {0, 0, 1};
    scene.cameras[0].up = {0, -1, 0};
    scene.cameras[0].position = {-50, 40, 0};
    EXPECT_THROW(frame_scene(scene, scene.cameras[0], {.width = 0.1, .height = 0.1}), Error);
}

}  // namespace
}  // namespace hogel
