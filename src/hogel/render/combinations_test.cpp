// SPDX-License-Identifier: Apache-2.0
// Compares every renderer with ray casting over combinations of options: numbers of hogels and directions down to one,
// faces and off-centre views, samples per ray, culling, and every shading model, on textures, gloss and shadows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hogel/render/cache_spacing.h"
#include "hogel/render/test_renderers.h"
#include "hogel/scene/mesh_builder.h"
#include "hogel/scene/shapes.h"
#include "hogel/shading.h"
#include "hogel/shading/radiance_cache.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

// A sloping textured wall, a glossy ball in front of it, and a matt triangle that shows its back and casts a shadow;
// around the hologram plane, or moved back by `back`.
Scene still_life(double back) {
    Scene scene;
    scene.background = {0.1f, 0.2f, 0.3f};
    scene.ambient = {0.1f, 0.1f, 0.1f};
    auto picture = std::make_shared<Image>(8, 6, 3);
    for (std::size_t i = 0; i < picture->pixels.size(); ++i)
        picture->pixels.data()[i] = 0.5f + 0.4f * std::sin(float(5 * i));
    Mesh wall;
    wall.positions = {{-7e-3, -6e-3, -3e-3}, {6e-3, -6.1e-3, -5e-3}, {6.2e-3, 5.9e-3, -5e-3}, {-6.8e-3, 6.2e-3, -3e-3}};
    wall.texture_coordinates = {{0, 0}, {2, 0}, {2, 1.5f}, {0, 1.5f}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    wall.material.base_color_texture = picture;
    Mesh sheet;
    sheet.positions = {{-3.3e-3, 0.2e-3, -1.1e-3}, {-0.6e-3, 0.4e-3, 0.3e-3}, {-2.1e-3, 2.9e-3, -0.4e-3}};
    sheet.triangles = {{0, 2, 1}};
    sheet.material.base_color = {0.9f, 0.3f, 0.2f};
    scene.meshes = {wall, sheet};
    scene::MeshBuilder builder;
    scene::add_ball(builder, {1.2e-3, -0.7e-3, -0.9e-3}, 1.7e-3, 14, 9, {0.3f, 0.7f, 0.4f});
    scene.meshes.push_back(builder.mesh);
    Material& ball = scene.meshes.back().material;
    ball.reflectance = 0.3f;
    ball.roughness = 0.4f;
    add_missing_normals(scene, 1);
    Light lamp;
    lamp.kind = Light::Kind::point;
    lamp.position = {-4e-3, 5e-3, 6e-3};
    lamp.intensity = {2e-4f, 1.8e-4f, 1.6e-4f};
    scene.lights.push_back(lamp);
    for (Mesh& mesh : scene.meshes)
        for (Vec3& p : mesh.positions) p.z -= back;
    scene.lights[0].position.z -= back;
    return scene;
}

struct Case {
    LightFieldGrid front;
    bool hemicube;
    SamplesPerRay samples;
    bool fronts_only;
    const char* model;
    double spacing;  // of the radiance cache, as a fraction of a sample's width; 0: no cache

    std::string text() const {
        return std::to_string(front.hogels_s) + "x" + std::to_string(front.hogels_t) + " hogels, " +
               std::to_string(front.directions_u) + "x" + std::to_string(front.directions_v) + " directions, samples " +
               std::to_string(samples.hogel) + "x" + std::to_string(samples.direction) + ", model " + model +
               (hemicube ? ", hemicube" : "") + (front.focal_plane() ? ", fixed focal plane" : "") +
               (fronts_only ? ", culled" : "") + (spacing > 0 ? ", radiance cache" : "");
    }
};

// The lengths of the lists have no common factors, so that all pairs of options occur.
std::vector<Case> cases() {
    struct Size {
        std::size_t hogels_s, hogels_t, directions_u, directions_v;
    };
    const Size sizes[] = {{1, 1, 12, 10}, {5, 4, 1, 1}, {1, 7, 9, 4}, {7, 1, 4, 9},  {4, 3, 18, 1}, {3, 4, 1, 17},
                          {3, 3, 3, 3},   {6, 5, 8, 6}, {1, 1, 1, 1}, {19, 2, 7, 5}, {2, 18, 5, 7}};
    const SamplesPerRay samples[] = {{1, 1}, {1, 1}, {2, 1}, {1, 3}, {1, 1}, {2, 2}, {1, 1}};
    const struct {
        const char* model;
        double spacing;
    } light[] = {{"vertex", 0}, {"direct", 0}, {"direct", 0.25}, {"shadowed", 0}, {"shadowed", 0.25}};
    std::vector<Case> list;
    for (std::size_t i = 0; i < 55; ++i) {
        const Size& n = sizes[i % std::size(sizes)];
        Case one{{n.hogels_s, n.hogels_t, 0.9_mm, n.directions_u, n.directions_v, Perspective{0.6, 0.5},
                  i % 4 == 1 ? 1u : 3u},
                 i % 3 == 1 && n.directions_u % 2 == 0 && (n.directions_v % 2 == 0 || n.directions_v == 1),
                 samples[i % std::size(samples)],
                 i % 2 == 1,
                 light[i % std::size(light)].model,
                 light[i % std::size(light)].spacing};
        if (one.hemicube) {
            one.front.range().half_u = one.front.range().half_v = 1;
        } else if (i % 3 == 2) {
            one.front.range().center_u = 0.31;
            one.front.range().center_v = -0.23;
        }
        // Cameras a few lengths of the scene away from it, or the focus behind it.
        if (!one.hemicube && i % 4 >= 2) one.front.view = FocalPlane{one.front.range(), i % 8 < 4 ? -20_mm : 30_mm};
        list.push_back(one);
    }
    return list;
}

class Combinations : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, Combinations, ::testing::ValuesIn(renderer_names("raytrace")),
                         [](const auto& parameter) { return test_name(parameter.param); });

// Rounding decides for rays along edges. With a radiance cache, epi interpolates between knots where the other
// renderers read the cache, which makes a difference at the edges of shadows. In the projection of a scene through a
// fixed focal plane, the points of the cache are at different positions, and values interpolated between vertices are
// shifted by up to a hundredth of a sample.
TEST_P(Combinations, agree_with_ray_casting) {
    std::size_t hits = 0, rays = 0, hemicubes = 0, focal_planes = 0;
    std::size_t number = 0;
    for (const Case& one : cases()) {
        if (cuts_simplices(GetParam()) && number++ / 2 % 3 != 0) continue;  // slow
        const Scene scene = still_life(crosses_plane(GetParam()) ? 0 : 1e-3);
        ShadedScene lit = shade_scene(scene, {.model = one.model, .shadow_map = 64});
        lit.fronts_only = one.fronts_only;
        if (one.spacing > 0)
            shading::add_radiance_cache(lit, cache_spacing(lit, finer(one.front, one.samples), one.spacing));
        const auto shaded = std::make_shared<const ShadedScene>(std::move(lit));
        const std::vector<LightFieldGrid> faces = one.hemicube ? hemicube(one.front) : std::vector{one.front};
        hemicubes += faces.size() > 1 ? 1 : 0;
        focal_planes += one.front.focal_plane() ? 1 : 0;
        std::size_t off = 0, far_off = 0, depths_off = 0, values = 0;
        for (const LightFieldGrid& face : faces) {
            const LightFieldBuffer truth = render("raytrace", shaded, face, one.samples),
                                   seen = render(GetParam(), shaded, face, one.samples);
            for (std::size_t i = 0; i < truth.depth.size(); ++i) {
                const float expected = truth.depth.data()[i], found = seen.depth.data()[i];
                depths_off += found == expected || std::abs(found - expected) < 1e-7f ? 0 : 1;
                hits += std::isfinite(expected) ? 1 : 0;
            }
            for (std::size_t i = 0; i < truth.radiance.size(); ++i) {
                const float expected = truth.radiance.data()[i], difference = seen.radiance.data()[i] - expected;
                off += std::abs(difference) < 1e-3f ? 0 : 1;
                far_off += std::abs(difference) < 0.02f ? 0 : 1;
            }
            rays += truth.depth.size();
            values += truth.radiance.size();
        }
        const bool projected = one.front.focal_plane() && !renderers().find(GetParam()).takes_focal_plane;
        const bool interpolates = projected || (GetParam() == "epi" && one.spacing > 0);
        EXPECT_LE(far_off, 1 + values / 300) << one.text();
        EXPECT_LE(off, 1 + values / (interpolates ? 10 : 300)) << one.text();
        EXPECT_LE(depths_off, 1 + values / 900) << one.text();
    }
    EXPECT_GT(hits, rays / 2);
    EXPECT_GE(hemicubes, 2u);
    EXPECT_GE(focal_planes, 5u);
}

}  // namespace
}  // namespace hogel::render
