// SPDX-License-Identifier: Apache-2.0
// Surfaces with masks, and blended surfaces: every renderer shows them in the same way.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hogel/error.h"
#include "hogel/render/test_renderers.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

const LightFieldGrid grid{6, 5, 1_mm, 14, 12, Perspective{0.3, 0.25}, 3};

struct Sheet {
    double depth;
    Rgb radiance;
    AlphaMode mode = AlphaMode::opaque;
    float alpha = 1;
    std::shared_ptr<const Image> texture = nullptr;
};

// A square that fills the view, with given radiance.
Mesh mesh_of(const Sheet& sheet, double half = 8e-3) {
    Mesh mesh;
    mesh.positions = {{-half, -half, -sheet.depth},
                      {half, -half, -sheet.depth},
                      {half, half, -sheet.depth},
                      {-half, half, -sheet.depth}};
    mesh.radiance.assign(4, sheet.radiance);
    mesh.texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material.alpha_mode = sheet.mode;
    mesh.material.alpha = sheet.alpha;
    mesh.material.base_color_texture = sheet.texture;
    return mesh;
}

std::shared_ptr<const ShadedScene> scene_of(const std::vector<Mesh>& meshes) {
    Scene scene;
    scene.name = "sheets";
    scene.meshes = meshes;
    scene.background = {0.1f, 0.2f, 0.3f};
    return std::make_shared<const ShadedScene>(shade_scene(scene, {.model = "given"}));
}

// White, with alpha 1 where a checkerboard of n × n squares is black and else 0.
std::shared_ptr<const Image> checkerboard(std::size_t n, float hole = 0) {
    auto image = std::make_shared<Image>(n, n, 4);
    for (std::size_t y = 0; y < n; ++y)
        for (std::size_t x = 0; x < n; ++x) {
            for (std::size_t c = 0; c < 3; ++c) image->pixels(y, x, c) = 1;
            image->pixels(y, x, 3) = (x + y) % 2 == 0 ? 1.0f : hole;
        }
    return image;
}

class Layers : public testing::TestWithParam<std::string> {};

TEST_P(Layers, that_are_opaque_everywhere_are_what_opaque_surfaces_are) {
    // The mask's alpha is below the cutoff only in one corner that no ray meets, so it stays a layer.
    auto corner = std::make_shared<Image>(64, 64, 4);
    std::ranges::fill(corner->pixels.elements(), 1.0f);
    corner->pixels(63, 0, 3) = 0;
    const auto opaque = scene_of({mesh_of({9e-3, {1, 2, 3}}), mesh_of({5e-3, {3, 1, 2}}, 2e-3)});
    Mesh masked = mesh_of({5e-3, {3, 1, 2}, AlphaMode::mask, 1, corner}, 2e-3);
    masked.texture_coordinates = {{0.2f, 0.2f}, {0.9f, 0.2f}, {0.9f, 0.9f}, {0.2f, 0.9f}};
    const auto layered = scene_of({mesh_of({9e-3, {1, 2, 3}}), masked});
    ASSERT_TRUE(layered->layers);
    ASSERT_FALSE(opaque->layers);
    const LightFieldBuffer a = render(GetParam(), opaque, grid), b = render(GetParam(), layered, grid);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < a.radiance.size(); ++i)
        differ += std::abs(a.radiance.data()[i] - b.radiance.data()[i]) > 1e-4f ? 1 : 0;
    EXPECT_LE(differ, a.radiance.size() / 200);  // rays through an edge, which epi decides by floats
    for (std::size_t i = 0; i < a.depth.size(); ++i) {
        const bool same_surface = std::abs(a.depth.data()[i] - b.depth.data()[i]) < 1e-3f;
        if (same_surface) {
            EXPECT_NEAR(a.depth.data()[i], b.depth.data()[i], 1e-7);
        }
    }
}

TEST_P(Layers, blend_from_the_nearest_on_whatever_their_order_in_the_scene) {
    const Mesh wall = mesh_of({9e-3, {1, 1, 1}}), red = mesh_of({6e-3, {1, 0, 0}, AlphaMode::blend, 0.25f}),
               green = mesh_of({3e-3, {0, 1, 0}, AlphaMode::blend, 0.5f}),
               hidden = mesh_of({12e-3, {9, 9, 9}, AlphaMode::blend, 0.5f});
    // From the closed form of "over": 0.5 (0, 1, 0) + 0.5 (0.25 (1, 0, 0) + 0.75 (1, 1, 1)).
    for (const auto& meshes : {std::vector{wall, red, green, hidden}, std::vector{hidden, green, red, wall}}) {
        const LightFieldBuffer seen = render(GetParam(), scene_of(meshes), grid);
        const std::size_t samples = seen.depth.size();
        for (std::size_t i = 0; i < samples; ++i) {
            EXPECT_NEAR(seen.radiance.data()[i], 0.5, 1e-6);
            EXPECT_NEAR(seen.radiance.data()[samples + i], 0.875, 1e-6);
            EXPECT_NEAR(seen.radiance.data()[2 * samples + i], 0.375, 1e-6);
            EXPECT_NEAR(seen.depth.data()[i], 3e-3, 1e-9);  // the nearest that is at least half opaque
        }
    }
    const LightFieldBuffer thin = render(GetParam(), scene_of({red, wall}), grid);
    for (const float depth : thin.depth.elements()) EXPECT_NEAR(depth, 9e-3, 1e-8);
    // Before the background.
    const LightFieldBuffer sky = render(GetParam(), scene_of({red, hidden}), grid);
    EXPECT_NEAR(sky.radiance.data()[0], 0.25 + 0.75 * (0.5 * 9 + 0.5 * 0.1), 1e-5);
}

TEST_P(Layers, show_their_holes_where_alpha_is_below_the_cutoff) {
    const double depth = 4e-3, half = 8e-3;
    const std::size_t n = 16;
    Mesh mask = mesh_of({depth, {1, 0, 0}, AlphaMode::mask, 1, checkerboard(n)}, half);
    mask.material.base_color_sampling.nearest = true;  // squares with edges
    const LightFieldBuffer seen = render(GetParam(), scene_of({mesh_of({9e-3, {0, 1, 0}}), mask}), grid);
    std::size_t holes = 0, checked = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t v = 0; v < grid.directions_v; ++v)
                for (std::size_t u = 0; u < grid.directions_u; ++u) {
                    const auto number = [](std::size_t i) { return static_cast<double>(i); };
                    const double x = grid.s(number(s)) + grid.u(number(u)) * depth,
                                 y = grid.t(number(t)) + grid.v(number(v)) * depth;
                    const double column = (x + half) / (2 * half) * n, row = (half - y) / (2 * half) * n;
                    const double from_edge =
                        std::min(std::abs(column - std::round(column)), std::abs(row - std::round(row)));
                    if (from_edge < 1e-3) continue;
                    const bool hole = (static_cast<int>(column) + static_cast<int>(row)) % 2 != 0;
                    holes += hole ? 1 : 0;
                    ++checked;
                    EXPECT_NEAR(seen.radiance(0, t, s, v, u), hole ? 0 : 1, 1e-6);
                    EXPECT_NEAR(seen.radiance(1, t, s, v, u), hole ? 1 : 0, 1e-6);
                    EXPECT_NEAR(seen.depth(t, s, v, u), hole ? 9e-3 : depth, 1e-8);
                }
    EXPECT_GT(checked, 3000u);
    EXPECT_GT(holes, checked / 4);
}

TEST_P(Layers, are_the_same_bytes_in_any_region_and_after_another_scene) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> aside(-4e-3, 4e-3), depth(1e-3, 9e-3);
    std::vector<Mesh> meshes;
    for (int i = 0; i < 24; ++i) {
        Mesh mesh = mesh_of({0,
                             {0.1f * static_cast<float>(i), 1, 0.5f},
                             static_cast<AlphaMode>(i % 3),
                             0.4f + 0.02f * static_cast<float>(i),
                             checkerboard(4, 0.6f)});
        for (Vec3& p : mesh.positions) p = {aside(random), aside(random), -depth(random)};
        meshes.push_back(mesh);
    }
    const auto scene = scene_of(meshes), plain = scene_of({mesh_of({9e-3, {1, 2, 3}})});
    const auto renderer = make_renderer(GetParam(), scene, grid);
    LightFieldTile whole(grid, {0, 0, grid.hogels_s, grid.hogels_t}, true);
    renderer->read(whole);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (const bool with_depth : {true, false}) {
                LightFieldTile one(grid, {s, t, 1, 1}, with_depth);
                renderer->read(one);
                for (std::size_t v = 0; v < grid.directions_v; ++v)
                    for (std::size_t u = 0; u < grid.directions_u; ++u)
                        for (std::size_t c = 0; c < 3; ++c)
                            ASSERT_EQ(one.radiance(c, 0, 0, v, u), whole.radiance(c, t, s, v, u));
            }
    renderer->set_scene(plain);
    LightFieldTile again(grid, whole.range, true);
    renderer->read(again);
    EXPECT_EQ(again.radiance(0, 2, 2, 5, 5), 1);
    renderer->set_scene(scene);
    renderer->read(again);
    EXPECT_TRUE(std::ranges::equal(again.radiance.elements(), whole.radiance.elements()));
}

TEST_P(Layers, are_seen_through_a_fixed_focal_plane_and_in_one_channel) {
    LightFieldGrid focal = grid;
    focal.view = FocalPlane{grid.range(), -0.1};
    const Mesh wall = mesh_of({9e-3, {1, 1, 1}}, 12e-3),
               veil = mesh_of({3e-3, {0, 1, 0}, AlphaMode::blend, 0.5f, checkerboard(8, 0.5f)}, 12e-3);
    const LightFieldBuffer seen = render(GetParam(), scene_of({wall, veil}), focal);
    const LightFieldBuffer truth = render("raytrace", scene_of({wall, veil}), focal);
    for (std::size_t i = 0; i < seen.radiance.size(); ++i)
        ASSERT_NEAR(seen.radiance.data()[i], truth.radiance.data()[i], 1e-4);
    // The position of a point on the veil, shown by its pattern, depends on the ray alone.
    const LightFieldGrid middle = focal.of_hogel(4, 3);
    const double x = focal.s(4) + middle.u(2) * 3e-3, y = focal.t(3) + middle.v(4) * 3e-3;
    const double opacity =
        0.5 * Texture(checkerboard(8, 0.5f), true)
                  .alpha({static_cast<float>((x + 12e-3) / 24e-3), static_cast<float>((y + 12e-3) / 24e-3)}, 0);
    EXPECT_NEAR(seen.radiance(0, 3, 4, 4, 2), 1 - opacity, 0.02);
    LightFieldGrid grey = grid;
    grey.channels = 1;
    const LightFieldBuffer one =
        render(GetParam(), scene_of({wall, mesh_of({3e-3, {0, 0, 1}, AlphaMode::blend, 0.5f})}), grey);
    EXPECT_NEAR(one.radiance.data()[0], 0.5 * 0.0722 + 0.5, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(AllRenderers, Layers, testing::ValuesIn(renderer_names()),
                         [](const auto& test) { return test_name(test.param); });

TEST(LayersOfAScene, are_only_surfaces_that_let_rays_through) {
    const auto opaque = checkerboard(2, 1);
    EXPECT_FALSE(scene_of({mesh_of({4e-3, {1, 1, 1}, AlphaMode::blend, 1, opaque})})->layers);
    EXPECT_FALSE(scene_of({mesh_of({4e-3, {1, 1, 1}, AlphaMode::mask, 0.6f, opaque})})->layers);
    EXPECT_FALSE(scene_of({mesh_of({4e-3, {1, 1, 1}, AlphaMode::opaque, 0.1f})})->layers);
    EXPECT_TRUE(scene_of({mesh_of({4e-3, {1, 1, 1}, AlphaMode::blend, 0.9f, opaque})})->layers);
    EXPECT_TRUE(scene_of({mesh_of({4e-3, {1, 1, 1}, AlphaMode::mask, 0.4f, opaque})})->layers);
    Mesh vertices = mesh_of({4e-3, {1, 1, 1}, AlphaMode::blend});
    vertices.alphas = {1, 1, 1, 0.5f};
    EXPECT_TRUE(scene_of({vertices})->layers);
}

}  // namespace
}  // namespace hogel::render
