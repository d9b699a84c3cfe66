// SPDX-License-Identifier: Apache-2.0
// The table of shading models, and shading a changed scene in the memory of the last one.
#include <gtest/gtest.h>

#include <string>

#include "hogel/error.h"
#include "hogel/shading.h"
#include "hogel/shading/radiance_cache.h"
#include "hogel/shading/test_scenes.h"

namespace hogel::shading {
namespace {

ShadingOptions model_named(const std::string& model) { return {.model = model, .shadow_map = 32}; }

std::shared_ptr<const Image> picture(float value) {
    auto image = std::make_shared<Image>(4, 4, 1);
    for (float& pixel : image->pixels.elements()) pixel = value;
    image->pixels(1, 2, 0) = 0;
    return image;
}

// A floor under a square that moves, with one lamp or two.
Scene moving_scene(double x, std::size_t lamps, const std::shared_ptr<const Image>& texture) {
    Scene scene;
    scene.meshes = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.8f, 0.4f, 1}),
                    square({x, 0.1, 0.5}, {0.3, 0, 0}, {0, 0.2, 0})};
    scene.meshes[0].texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.meshes[0].material.base_color_texture = texture;
    scene.meshes[0].material.reflectance = 0.04f;
    scene.meshes[0].material.roughness = 0.4f;
    scene.lights = {lamp({0.1 + x, 0, 2}, 3)};
    if (lamps > 1) scene.lights.push_back(lamp({-1, 0.5, 1}, 2));
    scene.ambient = {0.1f, 0.1f, 0.1f};
    return scene;
}

void expect_same(const ShadedScene& a, const ShadedScene& b) {
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.radiance, b.radiance);
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    EXPECT_EQ(a.textures.size(), b.textures.size());
    EXPECT_EQ(a.background, b.background);
    for (std::size_t i = 0; i < a.triangles.size(); ++i)
        for (const auto& [b1, b2] : {std::pair{0.1f, 0.2f}, {0.5f, 0.4f}, {0.05f, 0.9f}}) {
            const ViewSample view{normalize(Vec3{0.2, 0.1, 1}), 0.2};
            EXPECT_EQ(radiance_at(a, i, 1 - b1 - b2, b1, b2, view), radiance_at(b, i, 1 - b1 - b2, b1, b2, view));
        }
}

TEST(ShadeSceneInto, gives_what_shade_scene_gives) {
    const auto first = picture(0.5f), second = picture(0.25f);
    ShadedScene shaded;
    shaded.fronts_only = true;
    for (const char* model : {"vertex", "direct", "direct", "shadowed", "vertex", "direct", "shadowed"})
        for (const std::size_t lamps : {2, 1})
            for (const bool filtered : {true, false})
                for (const auto& texture : {first, second, std::shared_ptr<const Image>()}) {
                    const Scene scene = moving_scene(0.1 * double(lamps), lamps, texture);
                    ShadingOptions options = model_named(model);
                    options.filter_textures = filtered;
                    shade_scene_into(scene, options, shaded);
                    expect_same(shaded, shade_scene(scene, options));
                }
    EXPECT_TRUE(shaded.fronts_only);
}

TEST(ShadeSceneInto, uses_the_memory_of_the_last_shading) {
    const auto texture = picture(0.5f);
    for (const char* model : {"vertex", "direct", "shadowed"}) {
        ShadedScene shaded = shade_scene(moving_scene(0, 2, texture), model_named(model));
        add_radiance_cache(shaded, std::vector<float>(shaded.triangles.size(), 0.1f));
        const Vec3* positions = shaded.positions.data();
        const Rgb* radiance = shaded.radiance.data();
        const ShadedScene::Triangle* triangles = shaded.triangles.data();
        const SampleLighting* lighting = shaded.lighting.get();
        shade_scene_into(moving_scene(0.2, 2, texture), model_named(model), shaded);
        EXPECT_EQ(shaded.positions.data(), positions);
        EXPECT_EQ(shaded.radiance.data(), radiance);
        EXPECT_EQ(shaded.triangles.data(), triangles);
        EXPECT_EQ(shaded.lighting.get(), lighting) << model;
        EXPECT_EQ(shaded.radiance_cache, nullptr);
    }
}

TEST(ShadeSceneInto, leaves_lighting_alone_that_another_scene_shares) {
    const Scene first = moving_scene(0, 1, nullptr), second = moving_scene(0.4, 2, nullptr);
    ShadedScene shaded = shade_scene(first, model_named("direct"));
    const ShadedScene copied = shaded;
    shade_scene_into(second, model_named("direct"), shaded);
    expect_same(copied, shade_scene(first, model_named("direct")));
    expect_same(shaded, shade_scene(second, model_named("direct")));
}

// Maps on more than a tenth of the surface are shaded by `direct`, because `vertex` cannot show them.
TEST(ShadingModels, auto_is_direct_for_large_triangles_and_for_maps_of_gloss_or_relief) {
    Scene scene;
    scene.meshes = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), square({0, 0, 1}, {0.2, 0, 0}, {0, 0.2, 0})};
    scene.lights = {lamp({0, 0, 2}, 1)};
    scene.meshes[0].material.reflectance = 0.04f;
    scene.meshes[0].material.base_color_texture = picture(0.5f);
    EXPECT_EQ(shading_model(scene), "vertex");
    scene.meshes[1].material.normal_texture = picture(0.5f);  // on 4 % of the surface
    EXPECT_EQ(shading_model(scene), "vertex");
    scene.meshes[0].material.metallic_roughness_texture = picture(0.5f);
    EXPECT_EQ(shading_model(scene), "direct");
    scene.meshes[0].material.metallic_roughness_texture = nullptr;
    scene.meshes[0].material.normal_texture = picture(0.5f);
    EXPECT_EQ(shading_model(scene), "direct");
    EXPECT_EQ(shading_model(scene, {.max_shadow_bytes = 1}), "vertex");
    EXPECT_EQ(shading_model(scene, {.model = "shadowed"}), "shadowed");
    scene.meshes[0].material.normal_texture = nullptr;
    scene.has_large_triangles = true;
    EXPECT_EQ(shading_model(scene), "direct");
}

TEST(ShadingModels, unknown_names_are_usage_errors_that_list_the_known_ones) {
    for (const bool bytes : {false, true}) {
        try {
            bytes ? static_cast<void>(shadow_map_bytes({}, model_named("phong")))
                  : static_cast<void>(shade_scene(moving_scene(0, 1, nullptr), model_named("phong")));
            FAIL();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_NE(std::string(error.what()).find("vertex, direct, shadowed, given"), std::string::npos);
        }
    }
}

// A model in which the radiance of every vertex is the number of lights.
TEST(ShadingModels, a_model_that_a_program_adds_is_used_like_any_other) {
    shading_models().add({.name = "counted",
                          .text = "the number of lights",
                          .make =
                              [](const Scene& scene, const ShadingOptions&, ShadedScene& shaded, const Progress&) {
                                  const auto count = static_cast<float>(scene.lights.size());
                                  for (Rgb& vertex : shaded.radiance) vertex = {count, count, count};
                                  return nullptr;
                              },
                          .shadow_map_bytes = [](const Scene& scene,
                                                 const ShadingOptions&) { return 5.0 * double(scene.lights.size()); }});
    const Scene scene = moving_scene(0, 2, nullptr);
    ShadedScene shaded = shade_scene(scene, model_named("direct"));
    shade_scene_into(scene, model_named("counted"), shaded);
    EXPECT_EQ(radiance_at(shaded, 0, 0.2f, 0.3f, 0.5f).g, 2);
    EXPECT_EQ(shadow_map_bytes(scene, model_named("counted")), 10);
    ShadingOptions little = model_named("counted");
    little.max_shadow_bytes = 9;
    EXPECT_THROW(shade_scene(scene, little), Error);
}

}  // namespace
}  // namespace hogel::shading
