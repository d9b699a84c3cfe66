// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "hogel/error.h"
#include "hogel/resources.h"
#include "hogel/shading/test_scenes.h"

namespace hogel::shading {
namespace {

using std::numbers::pi;

Light directional(Vec3 direction, float irradiance) {
    Light light;
    light.direction = normalize(direction);
    light.intensity = {irradiance, irradiance, irradiance};
    return light;
}

TEST(Shading, in_ambient_light_a_surface_has_its_colour_times_that_light) {
    Scene scene;
    scene.meshes.push_back(square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    scene.meshes[0].material.base_color = {0.5f, 0.25f, 1};
    scene.meshes[0].colors = {{1, 1, 1}, {0.5f, 1, 1}, {1, 0.5f, 1}, {1, 1, 0.5f}};
    scene.ambient = {2, 4, 8};
    const ShadedScene shaded = shade_scene_vertices(scene);
    EXPECT_EQ(shaded.radiance[0], (Rgb{1, 1, 8}));
    EXPECT_EQ(shaded.radiance[1], (Rgb{0.5f, 1, 8}));
    EXPECT_EQ(shaded.radiance[3], (Rgb{1, 1, 4}));
    EXPECT_EQ(radiance_at(shaded, 0, 0.5f, 0.5f, 0), (Rgb{0.75f, 1, 8}));
}

TEST(Shading, emission_is_visible_without_lights) {
    Scene scene;
    scene.meshes.push_back(square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    scene.meshes[0].material.emission = {0.5f, 1, 2};
    scene.background = {1, 2, 3};
    const ShadedScene shaded = shade_scene_vertices(scene);
    EXPECT_EQ(radiance_at(shaded, 1, 0.25f, 0.25f, 0.5f), (Rgb{0.5f, 1, 2}));
    EXPECT_EQ(shaded.background, scene.background);
}

TEST(Shading, directional_light_is_proportional_to_the_cosine_on_the_front) {
    for (double degrees : {0.0, 30.0, 60.0, 85.0, 95.0, 150.0}) {
        const double angle = degrees * pi / 180;
        Scene scene;
        scene.meshes.push_back(square({0, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, {0, 1, 0}));
        scene.lights.push_back(directional({0, 0, -3}, 2));
        EXPECT_NEAR(shade_scene_vertices(scene).radiance[2].r, 2 * std::max(0.0, std::cos(angle)) / pi, 1e-6)
            << degrees;
    }
}

TEST(Shading, point_light_falls_off_with_the_square_of_the_distance) {
    for (double distance : {0.01, 0.02, 1.0, 5.0}) {
        Scene scene;
        scene.meshes.push_back(square({0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}));
        const Vec3 corner = scene.meshes[0].positions[1];
        scene.lights.push_back(lamp(corner + Vec3{0.6 * distance, 0, 0.8 * distance}, 3));
        const double expected = 3 * 0.8 / (pi * distance * distance);
        EXPECT_NEAR(shade_scene_vertices(scene).radiance[1].g, expected, 1e-6 * expected);
    }
}

TEST(Shading, only_surfaces_between_point_and_lamp_cast_shadows) {
    Scene scene;
    Mesh floor = square({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    floor.positions.push_back({0, 0, 0});
    floor.normals.push_back({0, 0, 1});
    scene.meshes.push_back(floor);
    scene.meshes.push_back(square({0, 0, 1}, {0.1, 0, 0}, {0, 0.1, 0}));
    scene.lights.push_back(lamp({0, 0, 2}, static_cast<float>(4 * pi)));
    EXPECT_EQ(shade_scene_vertices(scene).radiance[4].r, 0);  // the middle of the floor, below the blocker
    EXPECT_GT(shade_scene_vertices(scene).radiance[0].r, 0.1f);
    scene.lights[0].casts_shadows = false;
    EXPECT_NEAR(shade_scene_vertices(scene).radiance[4].r, 1, 1e-6);
    scene.lights[0] = lamp({0, 0, 0.5}, static_cast<float>(pi / 4));
    EXPECT_NEAR(shade_scene_vertices(scene).radiance[4].r, 1, 1e-6);
    scene.lights[0] = directional({0, 0, -1}, static_cast<float>(pi));
    EXPECT_EQ(shade_scene_vertices(scene).radiance[4].r, 0);
}

TEST(Shading, a_convex_surface_does_not_shadow_itself) {
    Scene scene;
    Mesh ball;
    constexpr std::uint32_t rows = 40, columns = 80;
    for (std::uint32_t i = 0; i <= rows; ++i)
        for (std::uint32_t k = 0; k < columns; ++k) {
            const double a = pi * i / rows, b = 2 * pi * k / columns;
            ball.normals.push_back({std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b)});
            ball.positions.push_back(1e-3 * ball.normals.back());
            if (i == rows) continue;
            const std::uint32_t here = i * columns + k, next = i * columns + (k + 1) % columns;
            ball.triangles.push_back({here, here + columns, next + columns});
            ball.triangles.push_back({here, next + columns, next});
        }
    ball.material.base_color = {1, 1, 1};
    scene.meshes.push_back(ball);
    scene.lights.push_back(directional({1, -2, -3}, 1));
    const ShadedScene shaded = shade_scene_vertices(scene);
    for (std::size_t i = 0; i < ball.normals.size(); ++i)
        EXPECT_NEAR(shaded.radiance[i].r, std::max(0.0, -dot(ball.normals[i], scene.lights[0].direction)) / pi, 1e-6);
}

TEST(Shading, does_not_depend_on_the_number_of_threads) {
    Scene scene;
    for (int i = 0; i < 50; ++i) {
        scene.meshes.push_back(square({0.1 * i, 0.03 * i, 0.2 * i}, {1, 0, 0.1}, {0, 1, 0.2}));
        Mesh& mesh = scene.meshes.back();
        for (int k = 0; k < 100; ++k) {
            mesh.positions.push_back({0.1 * i + 0.01 * k - 0.5, 0.03 * i, 0.2 * i + 0.001 * k});
            mesh.normals.push_back({0, 0, 1});
        }
    }
    scene.lights.push_back(lamp({3, 2, 15}, 4));
    const ShadedScene all = shade_scene_vertices(scene);
    const ThreadLimit one(1);
    EXPECT_EQ(all.radiance, shade_scene_vertices(scene).radiance);
}

TEST(Shading, textures_interpolate_between_texel_centres_and_repeat) {
    auto image = std::make_shared<Image>(2, 2, 1);
    image->pixels(0, 0, 0) = 1, image->pixels(0, 1, 0) = 2;  // top row
    image->pixels(1, 0, 0) = 4, image->pixels(1, 1, 0) = 8;
    Scene scene;
    scene.ambient = {1, 1, 1};
    scene.meshes.push_back(square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    Mesh& mesh = scene.meshes[0];
    mesh.material.base_color_texture = image;
    const auto at = [&](float u, float v) {
        mesh.texture_coordinates.assign(4, {u, v});
        return radiance_at(shade_scene_vertices(scene), 0, 0.2f, 0.3f, 0.5f).g;
    };
    EXPECT_FLOAT_EQ(at(0.25f, 0.75f), 1);
    EXPECT_FLOAT_EQ(at(0.75f, 0.75f), 2);
    EXPECT_FLOAT_EQ(at(0.25f, 0.25f), 4);
    EXPECT_FLOAT_EQ(at(0.75f, 0.25f), 8);
    EXPECT_FLOAT_EQ(at(0.5f, 0.75f), 1.5f);
    EXPECT_FLOAT_EQ(at(0.375f, 0.25f), 5);
    EXPECT_FLOAT_EQ(at(0.5f, 0.5f), 15.0f / 4);
    EXPECT_FLOAT_EQ(at(0, 0), 15.0f / 4);  // wraps around both ways
    EXPECT_FLOAT_EQ(at(-3.75f, 5.75f), 1);
}

TEST(Shading, meshes_share_a_texture_and_keep_their_index) {
    auto image = std::make_shared<Image>(1, 1, 3);
    Scene scene;
    scene.meshes.assign(3, square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    scene.meshes[0].material.base_color_texture = scene.meshes[2].material.base_color_texture = image;
    const ShadedScene shaded = shade_scene_vertices(scene);
    EXPECT_EQ(shaded.textures.size(), 1u);
    EXPECT_EQ(shaded.triangles[1].texture, 0u);
    EXPECT_EQ(shaded.triangles[2].texture, ShadedScene::no_texture);
    EXPECT_EQ(shaded.triangles[5].mesh, 2u);
    EXPECT_EQ(shaded.triangles[5].vertices[0], 8u);
    EXPECT_EQ(shaded.texture_coordinates.size(), shaded.positions.size());
}

TEST(Shading, refuses_lit_meshes_without_normals_and_empty_scenes) {
    Scene scene;
    EXPECT_THROW(shade_scene_vertices(scene), Error);
    scene.meshes.push_back(square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    scene.meshes[0].normals.clear();
    EXPECT_NO_THROW(shade_scene_vertices(scene));
    scene.lights.push_back(directional({0, 0, -1}, 1));
    EXPECT_THROW(shade_scene_vertices(scene), Error);
}

}  // namespace
}  // namespace hogel::shading
