// SPDX-License-Identifier: Apache-2.0
// Compares lighting at samples with closed forms and with lighting at vertices.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "hogel/error.h"
#include "hogel/resources.h"
#include "hogel/shading.h"
#include "hogel/shading/test_scenes.h"

namespace hogel::shading {
namespace {

using std::numbers::pi;

const Rgb violet{0.8f, 0.4f, 1};

ShadingOptions by(const std::string& model, std::size_t shadow_map = 128) {
    ShadingOptions options;
    options.model = model;
    options.shadow_map = shadow_map;
    return options;
}

/// A floor, a small roof over part of it, one lamp with shadows and one without.
Scene roofed() {
    Scene scene;
    scene.meshes = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, violet),
                    square({0.2, 0.1, 0.5}, {0.3, 0, 0}, {0, 0.2, 0}, violet)};
    scene.lights = {lamp({0.1, 0, 2}, 3), lamp({-1, 0.5, 1}, 2)};
    scene.lights[1].casts_shadows = false;
    scene.ambient = {0.1f, 0.1f, 0.1f};
    scene.meshes[0].material.emission = {0.05f, 0, 0};
    return scene;
}

// Exact even in the middle of a large triangle, where interpolation between vertices would be far off.
TEST(SampleLighting, direct_is_the_closed_form_at_every_point) {
    Scene scene = roofed();
    const ShadedScene shaded = shade_scene(scene, by("direct"));
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> part(0, 1);
    int lit = 0, dark = 0;
    for (int i = 0; i < 500; ++i) {
        const float b1 = part(engine), b2 = part(engine) * (1 - b1);
        const Vec3 p = double(1 - b1 - b2) * Vec3{-1, -1, 0} + double(b1) * Vec3{1, -1, 0} + double(b2) * Vec3{1, 1, 0};
        const Vec3 through = p + 0.25 * (scene.lights[0].position - p);  // at the height of the roof
        const double edge = std::max(std::abs(through.x - 0.2) - 0.3, std::abs(through.y - 0.1) - 0.2);
        if (std::abs(edge) < 0.04) continue;
        double e = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const Vec3 to_light = scene.lights[k].position - p;
            const double r = length(to_light);
            if (k == 1 || edge > 0) e += scene.lights[k].intensity.r * to_light.z / (r * r * r);
        }
        (edge > 0 ? lit : dark)++;
        const Rgb seen = radiance_at(shaded, 0, 1 - b1 - b2, b1, b2);
        ASSERT_NEAR(seen.r, 0.8 * (0.1 + e / pi) + 0.05, 1e-5);
        ASSERT_NEAR(seen.g, 0.4 * (0.1 + e / pi), 1e-5);
    }
    EXPECT_GT(lit, 100);
    EXPECT_GT(dark, 20);
}

TEST(SampleLighting, shadowed_is_the_light_of_vertex_shading_where_no_shadow_falls) {
    Scene scene = roofed();
    const ShadedScene at_vertices = shade_scene_vertices(scene), shadowed = shade_scene(scene, by("shadowed"));
    for (const auto& [b1, b2] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {0.1f, 0.05f}, {0.02f, 0.9f}}) {
        const Rgb a = radiance_at(at_vertices, 0, 1 - b1 - b2, b1, b2),
                  b = radiance_at(shadowed, 0, 1 - b1 - b2, b1, b2);
        EXPECT_NEAR(a.r, b.r, 1e-6);
        EXPECT_NEAR(a.b, b.b, 1e-6);
    }
    // In the middle of the shadow only the lamp without shadows remains.
    scene.lights[0].intensity = {0, 0, 0};
    const ShadedScene without = shade_scene_vertices(scene);
    const Rgb in_shadow = radiance_at(shadowed, 0, 0.35f, 0.1f, 0.55f);
    EXPECT_NEAR(in_shadow.g, radiance_at(without, 0, 0.35f, 0.1f, 0.55f).g, 1e-6);
    EXPECT_LT(in_shadow.g, 0.8f * radiance_at(at_vertices, 0, 0.35f, 0.1f, 0.55f).g);
}

TEST(SampleLighting, a_glossy_surface_is_brightest_in_the_mirror_direction_of_the_lamp) {
    Scene scene;
    scene.meshes = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, violet)};
    scene.meshes[0].material.reflectance = 0.04f;
    scene.meshes[0].material.roughness = 0.3f;
    scene.lights = {lamp({-1, 0, 1}, 2)};
    const ShadedScene glossy = shade_scene(scene, by("direct"));
    scene.meshes[0].material.reflectance = 0;
    const ShadedScene matt = shade_scene(scene, by("direct"));
    const auto middle = [](const ShadedScene& shaded, Vec3 to_viewer) {
        return radiance_at(shaded, 0, 0.5f, 0, 0.5f, {normalize(to_viewer), 0}).r;
    };
    EXPECT_GT(middle(glossy, {1, 0, 1}), 1.3f * middle(matt, {1, 0, 1}));
    EXPECT_LT(middle(glossy, {-1, 0, 0.4}), middle(matt, {-1, 0, 0.4}));
    EXPECT_EQ(middle(matt, {1, 0, 1}), middle(matt, {-1, 0, 0.4}));
}

TEST(SampleLighting, given_radiance_is_kept_by_every_model) {
    Scene scene = roofed();
    scene.meshes[0].radiance = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0, 0, 0}};
    for (const ShadingInfo& info : shading_models().rows()) {
        if (info.name == "given") {
            EXPECT_THROW(shade_scene(scene, by(info.name)), Error);
            continue;
        }
        const Rgb seen = radiance_at(shade_scene(scene, by(info.name)), 0, 0.5f, 0.25f, 0.25f);
        EXPECT_NEAR(seen.r, 3.25f, 1e-6) << info.name;
        EXPECT_NEAR(seen.g, 4.25f, 1e-6) << info.name;
    }
    scene.meshes[1].radiance.assign(4, {0.5f, 0.5f, 0.5f});
    EXPECT_EQ(radiance_at(shade_scene(scene, by("given")), 3, 0.5f, 0.25f, 0.25f).r, 0.5f);
}

TEST(SampleLighting, shadow_maps_that_are_too_large_are_refused_with_their_size) {
    const Scene scene = roofed();
    ShadingOptions options = by("direct", 1000);
    EXPECT_EQ(shadow_map_bytes(scene, options), 6 * 4 * 1e6);
    options.max_shadow_bytes = 23e6;
    try {
        shade_scene(scene, options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find("take 0.024 GB; expected at most 0.023 GB"), std::string::npos)
            << error.what();
    }
    options.shadow_map = 0;
    EXPECT_THROW(shade_scene(scene, options), Error);
    options.model = "vertex";
    EXPECT_EQ(shadow_map_bytes(scene, options), 0);
    EXPECT_NO_THROW(shade_scene(scene, options));
}

TEST(SampleLighting, radiance_on_triangles_without_area_is_finite) {
    Scene scene = roofed();
    scene.meshes[0].triangles.push_back({0, 1, 1});
    scene.meshes[0].positions[3] = scene.meshes[0].positions[0];
    for (const char* model : {"direct", "shadowed"}) {
        const ShadedScene shaded = shade_scene(scene, by(model));
        for (const std::size_t index : {1, 2}) {
            const Rgb seen = radiance_at(shaded, index, 0.4f, 0.3f, 0.3f);
            EXPECT_TRUE(std::isfinite(seen.r) && std::isfinite(seen.g) && std::isfinite(seen.b));
        }
    }
}

TEST(SampleLighting, does_not_depend_on_the_number_of_threads) {
    const Scene scene = roofed();
    const ShadedScene many = shade_scene(scene, by("direct"));
    const ThreadLimit one(1);
    const ShadedScene single = shade_scene(scene, by("direct"));
    for (int i = 0; i < 200; ++i) {
        const float b1 = float(i) / 200, b2 = (1 - b1) * float((7 * i) % 10) / 10;
        EXPECT_EQ(radiance_at(many, 0, 1 - b1 - b2, b1, b2), radiance_at(single, 0, 1 - b1 - b2, b1, b2));
    }
}

}  // namespace
}  // namespace hogel::shading
