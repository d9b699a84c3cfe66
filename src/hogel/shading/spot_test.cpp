// SPDX-License-Identifier: Apache-2.0
// Spot lights, and the shadows of point clouds.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "hogel/scene.h"
#include "hogel/shading.h"
#include "hogel/shading/illumination.h"
#include "hogel/shading/test_scenes.h"

namespace hogel::shading {
namespace {

Light spot(double inner, double outer) {
    Light light = lamp({0, 0, 2}, 3);
    light.direction = {0, 0, -1};
    light.inner_cone = inner;
    light.outer_cone = outer;
    return light;
}

TEST(PsfTable, shine_into_their_cone) {
    const double inner = 0.3, outer = 0.6;
    const Light light = spot(inner, outer);
    const auto share = [&](double angle) { return illuminate(light, {2 * std::tan(angle), 0, 0}).in_cone; };
    EXPECT_EQ(share(0), 1);
    EXPECT_EQ(share(0.29), 1);
    EXPECT_EQ(share(0.61), 0);
    // KHR_lights_punctual: the square of the cosine's position within the edge of the cone.
    const double part = (std::cos(0.45) - std::cos(outer)) / (std::cos(inner) - std::cos(outer));
    EXPECT_NEAR(share(0.45), part * part, 1e-12);
    const Illumination from = illuminate(light, {2 * std::tan(0.45), 0, 0});
    EXPECT_NEAR(from.falloff, part * part / (from.distance * from.distance), 1e-12);
    EXPECT_EQ(illuminate(lamp({0, 0, 2}, 3), {50, 0, 0}).in_cone, 1);  // no cone
    EXPECT_EQ(illuminate(spot(0.5, 0.5), {2 * std::tan(0.49), 0, 0}).in_cone, 1);
    EXPECT_EQ(illuminate(spot(0.5, 0.5), {2 * std::tan(0.51), 0, 0}).in_cone, 0);
}

// A point in the cone's edge is lit as by a point light of the edge's factor, by every model, with and without gloss.
TEST(PsfTable, light_surfaces_as_point_lights_of_that_share) {
    for (const std::string model : {"vertex", "shadowed", "direct"})
        for (const float reflectance : {0.0f, 0.04f}) {
            Scene spotted;
            spotted.meshes = {square({0, 0, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}, {0.5f, 0.5f, 0.5f})};
            for (Vec3& p : spotted.meshes[0].positions) p.x += 1;
            spotted.meshes[0].material.reflectance = reflectance;
            spotted.meshes[0].material.roughness = 0.4f;
            spotted.lights = {spot(0.3, 0.6)};
            Scene plain = spotted;
            const double share = illuminate(spotted.lights[0], {1, 0, 0}).in_cone;
            ASSERT_GT(share, 0.05);
            ASSERT_LT(share, 0.95);
            plain.lights = {lamp({0, 0, 2}, static_cast<float>(3 * share))};
            const auto seen = [&](const Scene& scene) {
                const ShadedScene shaded = shade_scene(scene, {.model = model, .shadow_map = 64});
                return radiance_at(shaded, 0, 0.3f, 0.3f, 0.4f, {normalize({0.4, 0, 1}), 0});
            };
            EXPECT_GT(seen(plain).r, 0.01f) << model;
            EXPECT_NEAR(seen(spotted).r / seen(plain).r, 1, 1e-5) << model << ' ' << reflectance;
        }
}

// Intersecting discs do not darken each other: on a wavy cloud all of them face the light.
TEST(PointClouds, do_not_shadow_themselves_with_their_discs) {
    Mesh discs;
    discs.name = points_name;
    for (int i = 0; i < 200; ++i) {
        const Vec3 middle{0.1 * (i % 20), 0.1 * (i / 20), 0.02 * ((7 * i) % 5)};
        const auto first = static_cast<std::uint32_t>(discs.positions.size());
        for (int k = 0; k < 6; ++k) {
            const double angle = k * std::numbers::pi / 3;
            discs.positions.push_back(middle + 0.15 * Vec3{std::cos(angle), std::sin(angle), 0});
            discs.normals.push_back({0, 0, 1});
        }
        for (std::uint32_t k = 1; k < 5; ++k) discs.triangles.push_back({first, first + k, first + k + 1});
    }
    discs.material.base_color = {1, 1, 1};
    Scene scene;
    scene.meshes = {discs};
    Light sun;
    sun.direction = normalize({0.1, 0.1, -1});
    sun.intensity = {1, 1, 1};
    scene.lights = {sun};
    const auto lit = static_cast<float>(dot(Vec3{0, 0, 1}, -sun.direction) / std::numbers::pi);
    const auto darkest = [&](const std::string& model) {
        const ShadedScene shaded = shade_scene(scene, {.model = model, .shadow_map = 256});
        float least = 1;
        for (std::size_t i = 0; i < shaded.triangles.size(); ++i)
            least = std::min(least, radiance_at(shaded, i, 0.2f, 0.4f, 0.4f, {{0, 0, 1}, 0}).r);
        return least;
    };
    for (const std::string model : {"vertex", "direct", "shadowed"}) EXPECT_NEAR(darkest(model), lit, 1e-5) << model;
    scene.meshes[0].name = "heap";  // its pieces are surfaces
    EXPECT_LT(darkest("vertex"), 0.9f * lit);
}

}  // namespace
}  // namespace hogel::shading
