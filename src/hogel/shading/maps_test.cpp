// SPDX-License-Identifier: Apache-2.0
// Emission and metallic-roughness textures, and the shadows of surfaces with holes.
#include "hogel/shading/maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hogel::shading {
namespace {

std::shared_ptr<const Image> constant(Rgb value) {
    auto image = std::make_shared<Image>(4, 4, 3);
    for (std::size_t y = 0; y < 4; ++y)
        for (std::size_t x = 0; x < 4; ++x)
            image->pixels(y, x, 0) = value.r, image->pixels(y, x, 1) = value.g, image->pixels(y, x, 2) = value.b;
    return image;
}

// A tilted square under two lights.
Scene lit_square() {
    Mesh mesh;
    mesh.positions = {{-1, -1, -0.2}, {1, -1, 0}, {1, 1, 0.2}, {-1, 1, 0}};
    mesh.normals.assign(4, normalize({-0.1, -0.1, 1}));
    mesh.texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material.base_color = {0.6f, 0.5f, 0.4f};
    mesh.material.reflectance = 0.04f;
    Scene scene;
    scene.name = "square";
    scene.meshes = {mesh};
    Light sun, lamp;
    sun.direction = normalize({0.3, -0.4, -1});
    sun.intensity = {2, 2, 1};
    lamp.kind = Light::Kind::point;
    lamp.position = {0.5, 0.5, 2};
    lamp.intensity = {1, 2, 3};
    scene.lights = {sun, lamp};
    scene.ambient = {0.1f, 0.1f, 0.2f};
    return scene;
}

Rgb seen(const Scene& scene, const std::string& model, float b1) {
    const ShadedScene shaded = shade_scene(scene, {.model = model, .shadow_map = 64});
    return radiance_at(shaded, 0, 0.7f - b1, b1, 0.3f, {normalize({0.1, 0.2, 1}), 0.01});
}

void expect_near(Rgb a, Rgb b, const std::string& what) {
    EXPECT_NEAR(a.r, b.r, 2e-6) << what;
    EXPECT_NEAR(a.g, b.g, 2e-6) << what;
    EXPECT_NEAR(a.b, b.b, 2e-6) << what;
}

TEST(Maps, of_one_value_are_that_value_in_every_model) {
    for (const std::string model : {"vertex", "shadowed", "direct"}) {
        Scene factor = lit_square(), texture = factor;
        factor.meshes[0].material.emission = {0.5f, 0.25f, 1};
        factor.meshes[0].material.metallic = 0.5f * 0.8f;
        factor.meshes[0].material.roughness = 0.75f * 0.4f;
        Material& material = texture.meshes[0].material;
        material.emission = {1, 1, 2};
        material.emission_texture = constant({0.5f, 0.25f, 0.5f});
        material.metallic = 0.5f;
        material.roughness = 0.75f;
        material.metallic_roughness_texture = constant({9, 0.4f, 0.8f});
        for (const float b1 : {0.1f, 0.35f, 0.6f})
            expect_near(seen(factor, model, b1), seen(texture, model, b1), model);
    }
}

TEST(Maps, of_level_normals_and_of_full_light_change_nothing) {
    const Scene plain = lit_square();
    Scene mapped = plain;
    mapped.meshes[0].material.normal_texture = constant({0.5f, 0.5f, 1});
    mapped.meshes[0].material.occlusion_texture = constant({1, 0, 0});
    for (const float b1 : {0.1f, 0.35f, 0.6f})
        expect_near(seen(plain, "direct", b1), seen(mapped, "direct", b1), "map");
}

// A normal map gives the normal along growing u and v and outwards, for any orientation of the texture.
TEST(Maps, of_tilted_normals_are_normals_of_vertices) {
    const double x = 0.4, y = -0.2, z = std::sqrt(1 - x * x - y * y);
    const auto stored = [](double value) { return static_cast<float>(0.5 * value + 0.5); };
    struct Case {
        std::vector<TextureCoordinate> coordinates;
        Vec3 along_u, along_v;
    };
    const std::vector<Case> cases{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {1, 0, 0}, {0, 1, 0}},
                                  {{{1, 0}, {0, 0}, {0, 1}, {1, 1}}, {-1, 0, 0}, {0, 1, 0}},   // mirrored
                                  {{{1, 0}, {1, 1}, {0, 1}, {0, 0}}, {0, -1, 0}, {1, 0, 0}}};  // turned
    for (const bool glossy : {false, true})
        for (const Case& test : cases) {
            Scene by_vertices = lit_square();
            Mesh& flat = by_vertices.meshes[0];
            for (Vec3& p : flat.positions) p.z = 0;
            flat.normals.assign(4, {0, 0, 1});
            flat.texture_coordinates = test.coordinates;
            if (!glossy) flat.material.reflectance = 0;
            Scene by_map = by_vertices;
            flat.normals.assign(4, x * test.along_u + y * test.along_v + z * Vec3{0, 0, 1});
            by_map.meshes[0].material.normal_texture = constant({stored(x), stored(y), stored(z)});
            for (const float b1 : {0.1f, 0.6f})
                expect_near(seen(by_vertices, "direct", b1), seen(by_map, "direct", b1), glossy ? "glossy" : "matt");
            by_map.meshes[0].material.normal_texture = constant({stored(2 * x), stored(2 * y), stored(z)});
            by_map.meshes[0].material.normal_scale = 0.5f;
            expect_near(seen(by_vertices, "direct", 0.3f), seen(by_map, "direct", 0.3f), "scale");
        }
}

TEST(Maps, of_occlusion_take_ambient_light_alone) {
    Scene scene = lit_square(), half = scene, dark = scene;
    half.ambient = 0.7f * half.ambient;
    scene.meshes[0].material.occlusion_texture = constant({0.4f, 9, 9});
    scene.meshes[0].material.occlusion_strength = 0.5f;
    for (const float reflectance : {0.0f, 0.04f}) {
        scene.meshes[0].material.reflectance = half.meshes[0].material.reflectance = reflectance;
        expect_near(seen(half, "direct", 0.3f), seen(scene, "direct", 0.3f), "occlusion");
    }
}

TEST(Maps, have_coordinates_of_their_own) {
    Scene scene = lit_square();
    scene.lights.clear();
    scene.ambient = {0, 0, 0};
    Mesh& mesh = scene.meshes[0];
    auto image = std::make_shared<Image>(2, 1, 1);
    image->pixels(0, 0, 0) = 1;
    image->pixels(0, 1, 0) = 3;
    mesh.material.emission = {1, 1, 1};
    mesh.material.emission_texture = image;
    mesh.material.emission_sampling.nearest = true;
    mesh.emission_coordinates.assign(4, {0.75f, 0.5f});
    EXPECT_EQ(seen(scene, "vertex", 0.1f).r, 3);
    mesh.emission_coordinates.assign(4, {0.25f, 0.5f});
    EXPECT_EQ(seen(scene, "direct", 0.1f).r, 1);
    // Given radiance replaces all light, emission too.
    mesh.radiance.assign(4, {7, 7, 7});
    EXPECT_EQ(seen(scene, "vertex", 0.1f).r, 7);
}

TEST(Maps, holes_let_light_through) {
    for (const std::string model : {"vertex", "shadowed", "direct"})
        for (const auto mode : {AlphaMode::mask, AlphaMode::blend}) {
            Scene scene = lit_square();
            scene.lights.resize(1);
            const Rgb unshadowed = seen(scene, model, 0.2f);
            Mesh blind = scene.meshes[0];
            for (Vec3& p : blind.positions) p = 3 * p + Vec3{0, 0, 1};
            scene.meshes.push_back(blind);
            const Rgb shadowed = seen(scene, model, 0.2f);
            EXPECT_LT(shadowed.r, 0.5f * unshadowed.r) << model;
            scene.meshes[1].material.alpha_mode = mode;
            scene.meshes[1].material.alpha = 0.4f;
            expect_near(seen(scene, model, 0.2f), unshadowed, model);
            scene.meshes[1].material.alpha = 0.6f;
            expect_near(seen(scene, model, 0.2f), shadowed, model);
        }
}

TEST(Sampling, continues_a_picture_as_it_says) {
    auto image = std::make_shared<Image>(4, 1, 1);
    for (std::size_t x = 0; x < 4; ++x) image->pixels(0, x, 0) = static_cast<float>(x);
    using Wrap = TextureSampling::Wrap;
    const auto at = [&](Wrap wrap, bool nearest, float u) {
        return Texture(image, false, {wrap, wrap, nearest}).sample({u, 0.5f}, 0).r;
    };
    for (const float u : {0.03f, 0.3f, 0.5f, 0.71f, 0.99f}) {
        EXPECT_NEAR(at(Wrap::repeat, false, u + 2), at(Wrap::repeat, false, u), 1e-5);
        EXPECT_NEAR(at(Wrap::mirror, false, -u), at(Wrap::mirror, false, u), 1e-5);
        EXPECT_NEAR(at(Wrap::mirror, false, 2 - u), at(Wrap::mirror, false, u), 1e-5);
        EXPECT_EQ(at(Wrap::clamp, false, -u), 0);
        EXPECT_EQ(at(Wrap::clamp, false, 1 + u), 3);
        EXPECT_EQ(at(Wrap::repeat, true, u), std::floor(4 * u));
        EXPECT_NEAR(at(Wrap::mirror, false, u), at(Wrap::clamp, false, u), 1e-6);
    }
    EXPECT_NEAR(at(Wrap::repeat, false, 0), 1.5, 1e-6);  // between the last texel and the first
    EXPECT_EQ(at(Wrap::clamp, false, 0), 0);
}

}  // namespace
}  // namespace hogel::shading
