// SPDX-License-Identifier: Apache-2.0
// After set_scene() a renderer gives bit for bit the samples of a new renderer.
#include <gtest/gtest.h>

#include <cmath>

#include "hogel/error.h"
#include "hogel/render/test_renderers.h"
#include "hogel/scene/mesh_builder.h"
#include "hogel/scene/shapes.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

const LightFieldGrid grid{6, 5, 1_mm, 20, 18, Perspective{0.5, 0.4}, 3};

// A textured wall and a glossy ball behind the hologram plane, at one moment of an animation.
Scene moving_scene(double moment) {
    Scene scene;
    static const std::shared_ptr<const Image> picture = [] {
        auto image = std::make_shared<Image>(8, 6, 3);
        for (std::size_t i = 0; i < image->pixels.size(); ++i)
            image->pixels.data()[i] = 0.5f + 0.4f * std::sin(float(5 * i));
        return image;
    }();
    Mesh wall;
    wall.positions = {{-4e-3, -4e-3, -7e-3}, {4e-3, -4e-3, -8e-3}, {4e-3, 4e-3, -8e-3}, {-4e-3, 4e-3, -7e-3}};
    wall.texture_coordinates = {{0, 0}, {2, 0}, {2, 1.5f}, {0, 1.5f}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    wall.material.base_color_texture = picture;
    scene::MeshBuilder builder;
    scene::add_ball(builder, {1.5e-3 * std::sin(moment), 0.7e-3 * std::cos(moment), -4e-3 - 1e-3 * moment}, 1.2e-3, 14,
                    9, {0.3f, 0.7f, 0.4f});
    scene.meshes = {wall, builder.mesh};
    scene.meshes[1].material.reflectance = 0.3f;
    scene.meshes[1].material.roughness = 0.4f;
    add_missing_normals(scene, 1);
    Light lamp;
    lamp.kind = Light::Kind::point;
    lamp.position = {-4e-3, 5e-3, 6e-3 + 1e-3 * moment};
    lamp.intensity = {2e-4f, 1.8e-4f, 1.6e-4f};
    scene.lights.push_back(lamp);
    scene.ambient = {0.1f, 0.1f, 0.1f};
    scene.background = {0.1f, 0.2f, 0.3f};
    scene::rotate(scene, 0.1 * moment, 0);
    return scene;
}

ShadingOptions by(const std::string& model) { return {.model = model, .shadow_map = 48}; }

class SetScene : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, SetScene, ::testing::ValuesIn(renderer_names()),
                         [](const auto& parameter) { return test_name(parameter.param); });

TEST_P(SetScene, gives_the_bytes_of_a_new_renderer) {
    for (const SamplesPerRay samples : {SamplesPerRay{1, 1}, {2, 1}})
        for (const LightFieldGrid& sampled : {grid, hemicube({3, 2, 1_mm, 8, 6, Perspective{1, 1}, 1})[1],
                                              LightFieldGrid{3, 4, 1_mm, 9, 7, FocalPlane{{0.4, 0.5}, -30_mm}, 3}}) {
            const auto moment = [](double t) {
                return std::make_shared<const ShadedScene>(shade_scene(moving_scene(t), by("direct")));
            };
            const auto renderer = make_renderer(GetParam(), moment(0), sampled, samples);
            for (const double t : {0.0, 0.8, 2.1}) {
                renderer->set_scene(moment(t));
                LightFieldBuffer again(sampled, true);
                copy(*renderer, again);
                EXPECT_TRUE(same_bytes(again, render(GetParam(), moment(t), sampled, samples))) << t;
            }
        }
}

// Smaller, larger and empty scenes, with and without back faces.
TEST_P(SetScene, takes_scenes_of_any_size) {
    std::mt19937 random(7);
    const auto renderer = make_renderer(GetParam(), std::make_shared<const ShadedScene>(), grid);
    for (const std::size_t count : {30, 7, 0, 50}) {
        ShadedScene scene = random_scene(random, count, true);
        scene.fronts_only = count == 7;
        renderer->set_scene(std::make_shared<const ShadedScene>(scene));
        LightFieldBuffer again(grid, true);
        copy(*renderer, again);
        EXPECT_TRUE(same_bytes(again, render(GetParam(), scene, grid))) << count;
    }
}

// As in the loop of a viewer, one scene is shaded again in place.
TEST_P(SetScene, takes_the_same_scene_with_new_contents) {
    for (const char* model : {"vertex", "shadowed", "direct"}) {
        const auto scene = std::make_shared<ShadedScene>(shade_scene(moving_scene(0), by(model)));
        const auto renderer = make_renderer(GetParam(), scene, grid);
        for (const double t : {0.5, 1.7}) {
            shade_scene_into(moving_scene(t), by(model), *scene);
            renderer->set_scene(scene);
            LightFieldBuffer again(grid, true);
            copy(*renderer, again);
            EXPECT_TRUE(same_bytes(again, render(GetParam(), shade_scene(moving_scene(t), by(model)), grid))) << model;
        }
    }
}

TEST(SetSceneOfSimplex, refuses_what_make_renderer_refuses) {
    ShadedScene behind, crossing;
    add_triangle(behind, {0, 0, -1e-3}, {1e-3, 0, -1e-3}, {0, 1e-3, -2e-3}, white);
    add_triangle(crossing, {0, 0, -1e-3}, {1e-3, 0, -1e-3}, {0, 1e-3, 2e-3}, white);
    const auto renderer = make_renderer("simplex", std::make_shared<const ShadedScene>(behind), grid);
    EXPECT_THROW(renderer->set_scene(std::make_shared<const ShadedScene>(crossing)), Error);
    renderer->set_scene(std::make_shared<const ShadedScene>(behind));
    LightFieldBuffer again(grid, true);
    copy(*renderer, again);
    EXPECT_TRUE(same_bytes(again, render("simplex", behind, grid)));
}

}  // namespace
}  // namespace hogel::render
