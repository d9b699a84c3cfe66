// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "hogel/error.h"
#include "hogel/scene.h"

namespace hogel {
namespace {

constexpr double quarter = std::numbers::pi / 2;

// One triangle whose corners are on the three axes, with a normal, texture coordinates and two lights.
Scene corner() {
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    mesh.normals.assign(3, {1, 0, 0});
    mesh.colors.assign(3, {0.5f, 0.5f, 0.5f});
    mesh.triangles = {{0, 1, 2}};
    Scene scene;
    scene.name = "corner";
    scene.meshes = {mesh};
    Light lamp, sun;
    lamp.kind = Light::Kind::point;
    lamp.position = {0, 0, 1};
    lamp.intensity = {4, 4, 4};
    sun.direction = {0, 0, -1};
    scene.lights = {lamp, sun};
    return scene;
}

void expect_near(Vec3 a, Vec3 b) {
    EXPECT_NEAR(a.x, b.x, 1e-12);
    EXPECT_NEAR(a.y, b.y, 1e-12);
    EXPECT_NEAR(a.z, b.z, 1e-12);
}

TEST(Pose, every_axis_can_be_up_without_a_mirror_image) {
    for (const Vec3 up :
         {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
        Scene scene = corner();
        Mesh& mesh = scene.meshes[0];
        mesh.positions = {up, cross(up, {up.y, up.z, up.x}), {up.y, up.z, up.x}};
        const double volume = dot(mesh.positions[0], cross(mesh.positions[1], mesh.positions[2]));
        turn_scene(scene, {.up = up});
        EXPECT_EQ(mesh.positions[0], (Vec3{0, 1, 0}));
        EXPECT_EQ(dot(mesh.positions[0], cross(mesh.positions[1], mesh.positions[2])), volume);
    }
    Scene scene = corner();
    turn_scene(scene, {.up = Vec3{0, 0, 1}});
    EXPECT_EQ(scene.meshes[0].positions[1], (Vec3{0, 0, -2}));  // what was behind in the drawing, −y faces the viewer
    EXPECT_THROW(turn_scene(scene, {.up = Vec3{0, 1, 1}}), Error);
}

TEST(Pose, rotations_are_about_x_then_y_then_z_and_take_normals_and_lights_along) {
    Scene scene = corner();
    turn_scene(scene, {.rotation = {quarter, 0, 0}});
    expect_near(scene.meshes[0].positions[1], {0, 0, 2});
    expect_near(scene.lights[0].position, {0, -1, 0});
    expect_near(scene.lights[1].direction, {0, 1, 0});
    scene = corner();
    turn_scene(scene, {.rotation = {0, quarter, 0}});
    expect_near(scene.meshes[0].positions[2], {3, 0, 0});
    expect_near(scene.meshes[0].normals[0], {0, 0, -1});
    scene = corner();
    turn_scene(scene, {.rotation = {0, 0, quarter}});
    expect_near(scene.meshes[0].positions[0], {0, 1, 0});
    scene = corner();
    turn_scene(scene, {.rotation = {quarter, quarter, 0}});
    expect_near(scene.meshes[0].positions[1], {2, 0, 0});  // to z first, then to x
}

TEST(Pose, scale_and_move_come_last_and_keep_the_light_on_surfaces) {
    Scene scene = corner();
    place_scene(scene, {.scale = 2, .shift = {1, 0, -1}}, 1);
    EXPECT_EQ(scene.meshes[0].positions[2], (Vec3{1, 0, 5}));
    EXPECT_EQ(scene.lights[0].position, (Vec3{1, 0, 1}));
    EXPECT_EQ(scene.lights[0].intensity, (Rgb{16, 16, 16}));
    EXPECT_THROW(place_scene(scene, {.scale = 0}, 1), Error);
}

TEST(Pose, colours_lights_and_background_replace_those_of_the_scene) {
    Scene scene = corner();
    Light other;
    other.intensity = {9, 0, 0};
    place_scene(scene, {.color = Rgb{1, 0.5f, 0}, .lights = {other}, .background = Rgb{0, 0, 1}}, 1);
    EXPECT_EQ(scene.meshes[0].material.base_color, (Rgb{1, 0.5f, 0}));
    EXPECT_TRUE(scene.meshes[0].colors.empty());
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].intensity.r, 9);
    EXPECT_EQ(scene.background.b, 1);
    const auto picture = std::make_shared<const Image>(2, 2, 3);
    EXPECT_THROW(place_scene(scene, {.texture = picture}, 1), Error);
    scene.meshes[0].texture_coordinates.resize(3);
    place_scene(scene, {.texture = picture}, 1);
    EXPECT_EQ(scene.meshes[0].material.base_color_texture, picture);
    EXPECT_EQ(scene.meshes[0].material.base_color, (Rgb{1, 1, 1}));
}

TEST(Pose, the_ground_lies_level_under_the_scene) {
    Scene scene = corner();
    place_scene(scene, {.shift = {0, -5, 0}, .ground = Rgb{0.2f, 0.3f, 0.4f}}, 10);
    ASSERT_EQ(scene.meshes.size(), 2u);
    const Mesh& ground = scene.meshes[1];
    for (const Vec3& p : ground.positions) EXPECT_EQ(p.y, -5);
    for (const auto& [a, b, c] : ground.triangles) {
        const Vec3 p = ground.positions[a];
        EXPECT_GT(cross(ground.positions[b] - p, ground.positions[c] - p).y, 0);  // seen from above
    }
    const auto [low, high] = bounds(scene);
    EXPECT_NEAR(high.x - low.x, 10, 1e-9);
    EXPECT_LE(low.z, 0);
    EXPECT_GE(high.z, 3);
    validate(scene);
}

}  // namespace
}  // namespace hogel
