// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hogel/error.h"
#include "hogel/scene/shapes.h"
#include "hogel/shading/test_scenes.h"

namespace hogel::shading {
namespace {

using std::numbers::pi;

/// A sphere of radius 1, seen from the inside.
Scene hollow_ball(float albedo, std::size_t columns = 40, std::size_t rows = 20) {
    scene::MeshBuilder builder;
    scene::add_ball(builder, {0, 0, 0}, 1, columns, rows, {1, 1, 1});
    for (auto& [a, b, c] : builder.mesh.triangles) std::swap(b, c);
    scene::drop_slivers(builder.mesh);
    for (const Vec3& p : builder.mesh.positions) builder.mesh.normals.push_back(-normalize(p));
    builder.mesh.material.base_color = {albedo, albedo, albedo};
    Scene scene;
    scene.meshes.push_back(std::move(builder.mesh));
    return scene;
}

Scene box(float albedo, float emission) {
    scene::MeshBuilder builder;
    scene::add_box(builder, {-1, -1, -1}, {1, 1, 1}, 0.5, [](Vec3) { return Rgb{1, 1, 1}; });
    for (auto& [a, b, c] : builder.mesh.triangles) std::swap(b, c);
    builder.mesh.material.base_color = {albedo, albedo, albedo};
    builder.mesh.material.emission = {emission, emission, emission};
    Scene scene;
    scene.meshes.push_back(std::move(builder.mesh));
    add_missing_normals(scene, 0.5);
    return scene;
}

// In a closed room of any shape whose walls emit radiance e and reflect half, the radiance is e (1 + ½ + ¼ + …).
TEST(Bake, a_furnace_has_the_radiance_of_its_series) {
    for (const std::size_t bounces : {0, 1, 2, 6}) {
        const Scene baked = bake_scene(box(0.5f, 1), {.rays = 16, .bounces = bounces});
        for (const Rgb& seen : baked.meshes[0].radiance)
            ASSERT_NEAR(seen.r, 2 - std::pow(0.5, double(bounces)), 1e-5) << bounces;
    }
}

// In an integrating sphere, reflected light is the same everywhere for any position of the lamp. With power Φ and
// albedo ρ its radiance is ρ²Φ/(4π²r²(1−ρ)), and the walls absorb the power of the lamp.
TEST(Bake, an_integrating_sphere_is_lit_uniformly) {
    constexpr double albedo = 0.6, intensity = 2, power = 4 * pi * intensity;
    Scene scene = hollow_ball(float(albedo));
    scene.lights = {lamp({0.4, 0.2, -0.1}, float(intensity))};
    const Scene baked = bake_scene(scene, {.rays = 192, .bounces = 12});
    const Scene direct = bake_scene(scene, {.rays = 1, .bounces = 0});
    const double expected = albedo * albedo * power / (4 * pi * pi * (1 - albedo));
    double mean = 0, area = 0, absorbed = 0;
    for (const auto& t : scene.meshes[0].triangles) {
        const auto& p = scene.meshes[0].positions;
        const double a = 0.5 * length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
        for (const std::uint32_t i : t) {
            const double total = baked.meshes[0].radiance[i].r;
            const double reflected = total - direct.meshes[0].radiance[i].r;
            EXPECT_NEAR(reflected, expected, 0.12 * expected);
            mean += a / 3 * reflected;
            absorbed += a / 3 * pi * total * (1 - albedo) / albedo;
            area += a / 3;
        }
    }
    EXPECT_NEAR(mean / area, expected, 0.02 * expected);
    EXPECT_NEAR(absorbed, power, 0.02 * power);
}

TEST(Bake, without_bounces_is_the_direct_light_at_the_vertices) {
    const Scene scene = hollow_ball(0.7f);
    Scene lit = scene;
    lit.lights = {lamp({0.3, 0, 0}, 1)};
    const ShadedScene vertices = shade_scene_vertices(lit);
    const Scene baked = bake_scene(lit, {.rays = 1, .bounces = 0});
    for (std::size_t i = 0; i < vertices.radiance.size(); ++i)
        ASSERT_NEAR(baked.meshes[0].radiance[i].g, vertices.radiance[i].g, 0.03 * vertices.radiance[i].g);
}

// A white floor is reddest beside a red wall.
TEST(Bake, colours_bleed) {
    scene::MeshBuilder red, white;
    red.patch(
        8, 8, false,
        [](std::size_t i, std::size_t k) {
            return Vec3{0, double(k) / 8, 1 - double(i) / 8};
        },
        [](Vec3) {
            return Rgb{1, 0, 0};
        });
    white.patch(
        8, 8, false,
        [](std::size_t i, std::size_t k) {
            return Vec3{double(i) / 8, 0, 1 - double(k) / 8};
        },
        [](Vec3) {
            return Rgb{1, 1, 1};
        });
    Scene scene;
    scene.meshes = {red.mesh, white.mesh};
    add_missing_normals(scene, 0.5);
    scene.lights = {lamp({0.5, 0.9, 0.5}, 1)};
    const Scene baked = bake_scene(scene, {.rays = 128, .bounces = 2});
    ASSERT_GT(scene.meshes[0].normals[0].x, 0.9);
    const auto excess = [&](std::size_t i) {
        const Rgb c = baked.meshes[1].radiance[i];
        return c.r / c.g;
    };
    EXPECT_GT(excess(4 * 9 + 1), 1.15f);              // beside the red wall
    EXPECT_LT(excess(4 * 9 + 8), excess(4 * 9 + 1));  // and farther away
}

TEST(Bake, tessellation_keeps_the_radiance_of_the_vertices) {
    const Scene scene = box(0.5f, 0.2f);
    const Scene coarse = bake_scene(scene, {.rays = 16, .bounces = 2}),
                fine = bake_scene(scene, {.rays = 16, .bounces = 2, .tessellation = 3});
    EXPECT_EQ(fine.meshes[0].triangles.size(), 9 * coarse.meshes[0].triangles.size());
    EXPECT_EQ(fine.meshes[0].radiance.size(), fine.meshes[0].positions.size());
    for (std::size_t i = 0; i < coarse.meshes[0].radiance.size(); ++i)
        EXPECT_NEAR(coarse.meshes[0].radiance[i].r, fine.meshes[0].radiance[i].r, 1e-6);
}

TEST(Bake, does_not_depend_on_the_number_of_threads_but_on_the_seed) {
    Scene scene = hollow_ball(0.6f, 20, 10);
    scene.lights = {lamp({0.4, 0.2, -0.1}, 2)};
    BakeOptions options{.rays = 16, .bounces = 2};
    const Scene many = bake_scene(scene, options);
    {
        const ThreadLimit one(1);
        EXPECT_EQ(many.meshes[0].radiance, bake_scene(scene, options).meshes[0].radiance);
    }
    options.seed = 2;
    EXPECT_NE(many.meshes[0].radiance, bake_scene(scene, options).meshes[0].radiance);
}

TEST(Bake, given_radiance_stays_and_lights_the_rest) {
    Scene scene = box(0.5f, 0);
    scene.meshes.push_back(hollow_ball(0).meshes[0]);
    for (Vec3& p : scene.meshes[1].positions) p = 0.6 * p;
    for (Vec3& n : scene.meshes[1].normals) n = -n;  // a sphere in the room
    scene.meshes[1].radiance.assign(scene.meshes[1].positions.size(), {3, 3, 3});
    const Scene baked = bake_scene(scene, {.rays = 64, .bounces = 2});
    EXPECT_EQ(baked.meshes[1].radiance, scene.meshes[1].radiance);
    for (const Rgb& seen : baked.meshes[0].radiance) EXPECT_GT(seen.r, 0.0f);
}

TEST(Bake, refuses_zero_rays_zero_parts_and_empty_scenes) {
    EXPECT_THROW(bake_scene(box(0.5f, 1), {.rays = 0}), Error);
    EXPECT_THROW(bake_scene(box(0.5f, 1), {.rays = 1, .tessellation = 0}), Error);
    EXPECT_THROW(bake_scene({}, {}), Error);
    EXPECT_THROW(bake_scene(box(0.5f, 1), {}, [](double) { return false; }), Error);
}

}  // namespace
}  // namespace hogel::shading
