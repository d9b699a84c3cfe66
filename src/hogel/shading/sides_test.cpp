// SPDX-License-Identifier: Apache-2.0
// The two sides of a sheet: which is visible, and how it is lit.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "hogel/scene.h"
#include "hogel/shading.h"
#include "hogel/shading/test_scenes.h"

namespace hogel::shading {
namespace {

constexpr float reflected = static_cast<float>(std::numbers::inv_pi);
constexpr std::array models{"vertex", "shadowed", "direct"};

Light light_along(Vec3 direction) {
    Light light;
    light.direction = normalize(direction);
    light.intensity = {2, 2, 2};
    return light;
}

/// A sheet behind the hologram that faces away from the viewer.
Mesh sheet_from_behind(bool double_sided) {
    Mesh mesh = square({0, 0, -0.5}, {-1, 0, 0}, {0, 1, 0});
    mesh.material.double_sided = double_sided;
    return mesh;
}

float seen(const Scene& scene, const char* model, bool fronts_only = false) {
    ShadedScene shaded;
    shaded.fronts_only = fronts_only;
    shade_scene_into(scene, {.model = model, .shadow_map = 64}, shaded);
    return radiance_at(shaded, 0, 0.4f, 0.3f, 0.3f).r;
}

TEST(Sides, of_a_double_sided_sheet_show_their_own_light) {
    for (const char* model : models)
        for (const bool double_sided : {false, true})
            for (const bool in_front : {false, true}) {
                Scene scene;
                scene.meshes = {sheet_from_behind(double_sided)};
                scene.lights = {light_along({0, 0, in_front ? -1.0 : 1.0})};
                EXPECT_NEAR(seen(scene, model), double_sided == in_front ? 2 * reflected : 0, 1e-5)
                    << model << " " << double_sided << in_front;
                EXPECT_NEAR(seen(scene, model, true), in_front ? 0 : 2 * reflected, 1e-5) << model;
            }
}

TEST(Sides, of_closed_bodies_change_nothing) {
    Scene scene = make_scene("sphere", 0.02);
    const ShadedScene single = shade_scene(scene, {.model = "vertex"});
    for (Mesh& mesh : scene.meshes) mesh.material.double_sided = true;
    const ShadedScene both = shade_scene(scene, {.model = "vertex"});
    EXPECT_EQ(single.positions, both.positions);
    EXPECT_EQ(single.radiance, both.radiance);
}

// A roof of two slopes that share the vertices of their ridge; the middle sees one slope from behind.
TEST(Sides, are_chosen_for_each_triangle) {
    Scene scene;
    Mesh& roof = scene.meshes.emplace_back();
    roof.positions = {{-1, -1, -2}, {-1, 1, -2}, {0, -1, -3}, {0, 1, -3}, {1, -1, -2}, {1, 1, -2}};
    // The left slope faces the viewer; the right one, in the order of its corners, does not.
    roof.triangles = {{0, 2, 3}, {2, 4, 5}};
    std::swap(roof.triangles[1][1], roof.triangles[1][2]);
    roof.normals = {normalize(Vec3{1, 0, 1}), normalize(Vec3{1, 0, 1}),  normalize(Vec3{1, 0, 1}),
                    normalize(Vec3{1, 0, 1}), normalize(Vec3{1, 0, -1}), normalize(Vec3{1, 0, -1})};
    roof.normals[2] = normalize(Vec3{1, 0, 0});
    roof.material.double_sided = true;
    scene.lights = {light_along({-1, 0, -1}), light_along({1, 0, -1})};
    for (const char* model : models) {
        const ShadedScene shaded = shade_scene(scene, {.model = model, .shadow_map = 64});
        ASSERT_EQ(shaded.triangles.size(), 2u);
        const auto middle = [&](std::size_t i) { return radiance_at(shaded, i, 0.1f, 0.45f, 0.45f).r; };
        EXPECT_GT(middle(0), reflected) << model;
        EXPECT_GT(middle(1), reflected) << model;
    }
}

// The leaf of a plant as modelling programs write it: a sheet for each side, with the same corners.
TEST(Sides, modelled_by_two_sheets_are_as_modelled) {
    for (const bool back_first : {false, true}) {
        Scene scene;
        Mesh front = square({0, 0, -0.5}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}), back = sheet_from_behind(true);
        front.material.double_sided = true;
        back.positions = front.positions;
        back.triangles = {{0, 2, 1}, {0, 3, 2}};
        back.material.base_color = {0.25f, 0.25f, 0.25f};
        scene.meshes = back_first ? std::vector{back, front} : std::vector{front, back};
        scene.lights = {light_along({0, 0, -1})};
        const ShadedScene shaded = shade_scene(scene, {.model = "vertex"});
        ASSERT_EQ(shaded.triangles.size(), 2u);
        EXPECT_NEAR(seen(scene, "vertex"), 2 * reflected, 1e-5) << back_first;
    }
}

}  // namespace
}  // namespace hogel::shading
