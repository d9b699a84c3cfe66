// SPDX-License-Identifier: Apache-2.0
// Compares every renderer on the built-in scenes with closed forms and with ray casting.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "hogel/render/test_renderers.h"
#include "hogel/scene.h"
#include "hogel/scene/analytic.h"
#include "hogel/shading.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

constexpr double size = 20_mm;

// The scene of this name, except a church baked with fewer rays and larger triangles for church-radiance.
Scene quick_scene(std::string_view name) {
    if (name != "church-radiance") return make_scene(name, size);
    Scene church = make_scene("church", size);
    for (Light& light : church.lights) light.casts_shadows = false;
    return bake_scene(church, {.rays = 2, .bounces = 1, .tessellation = 2});
}

using SharedScene = std::shared_ptr<const ShadedScene>;

// The scene as it is, or moved behind the hologram plane for a renderer that needs that.
SharedScene shaded_scene(std::string_view name, bool behind = false) {
    Scene scene = quick_scene(name);
    const double back = behind ? bounds(scene).high.z + 1_mm : 0;
    for (Mesh& mesh : scene.meshes)
        for (Vec3& position : mesh.positions) position.z -= back;
    // Without shadows, which take most time and are the same for all renderers.
    for (Light& light : scene.lights) {
        light.position.z -= back;
        light.casts_shadows = false;
    }
    return std::make_shared<const ShadedScene>(shade_scene_vertices(scene));
}

LightFieldBuffer rendered(std::string_view algorithm, const SharedScene& scene, const LightFieldGrid& grid) {
    LightFieldBuffer light_field(grid, true);
    copy(*make_renderer(algorithm, scene, grid), light_field);
    return light_field;
}

struct Case {
    std::string algorithm, scene;
};

std::vector<Case> analytic_cases() {
    std::vector<Case> list;
    for (const RendererInfo& renderer : renderers().rows())
        for (const SceneInfo& scene : scenes().rows())
            if (scene::has_analytic_radiance(scene.name) &&
                (renderer.crosses_plane || bounds(make_scene(scene.name, size)).high.z < 0))
                list.push_back({std::string(renderer.name), std::string(scene.name)});
    return list;
}

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
    return test_name(info.param.algorithm + "_" + info.param.scene);
}

class ClosedForm : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(RenderersAndScenes, ClosedForm, ::testing::ValuesIn(analytic_cases()), name_of);

TEST_P(ClosedForm, is_what_the_renderer_gives) {
    const auto& [algorithm, scene] = GetParam();
    const LightFieldGrid grid{16, 16, size / 16, 40, 40, Perspective{0.4, 0.4}, 3};
    const LightFieldBuffer seen = rendered(algorithm, shaded_scene(scene), grid);
    std::size_t compared = 0, hits = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t v = 0; v < grid.directions_v; ++v)
                for (std::size_t u = 0; u < grid.directions_u; ++u) {
                    const scene::AnalyticSample expected = scene::analytic_radiance(
                        scene, size, grid.s(double(s)), grid.t(double(t)), grid.u(double(u)), grid.v(double(v)));
                    if (expected.clearance < size / 1000) continue;
                    ++compared;
                    const float depth = seen.depth(t, s, v, u);
                    ASSERT_EQ(std::isfinite(depth), std::isfinite(expected.depth));
                    if (std::isfinite(depth)) {
                        ++hits;
                        ASSERT_NEAR(depth, expected.depth, 1e-3 * size);
                    }
                    ASSERT_NEAR(seen.radiance(0, t, s, v, u), expected.radiance.r, 1e-3);
                    ASSERT_NEAR(seen.radiance(1, t, s, v, u), expected.radiance.g, 1e-3);
                    ASSERT_NEAR(seen.radiance(2, t, s, v, u), expected.radiance.b, 1e-3);
                }
    EXPECT_GT(compared, grid.hogels() * grid.directions() * 9 / 10);
    EXPECT_GT(hits, 0u);
}

// Whether the depth is discontinuous between neighbouring directions, as at a silhouette.
bool near_silhouette(const LightFieldBuffer& light_field, std::size_t t, std::size_t s, std::size_t v, std::size_t u) {
    const LightFieldGrid& grid = light_field.grid();
    float low = light_field.depth(t, s, v, u), high = low;
    for (std::size_t l = v > 0 ? v - 1 : 0; l < std::min(v + 2, grid.directions_v); ++l)
        for (std::size_t k = u > 0 ? u - 1 : 0; k < std::min(u + 2, grid.directions_u); ++k) {
            low = std::min(low, light_field.depth(t, s, l, k));
            high = std::max(high, light_field.depth(t, s, l, k));
        }
    return low != high && !(high - low < 0.02 * size);
}

std::vector<Case> showpieces() {
    std::vector<Case> list;
    for (const RendererInfo& renderer : renderers().rows())
        for (const char* scene : {"pumpkin", "tower", "church", "church-radiance", "chandelier", "billiards"})
            if (renderer.name != "raytrace") list.push_back({std::string(renderer.name), scene});
    return list;
}

class Showpieces : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(RenderersAndScenes, Showpieces, ::testing::ValuesIn(showpieces()), name_of);

TEST_P(Showpieces, agree_with_ray_casting_away_from_silhouettes) {
    const auto& [algorithm, scene] = GetParam();
    // Smaller light fields for slow renderers.
    LightFieldGrid grid{5, 5, size / 5, 64, 64, Perspective{0.1, 0.1}, 3};
    if (algorithm == "oblique") grid = {5, 5, size / 5, 24, 24, Perspective{0.0375, 0.0375}, 3};
    if (algorithm == "simplex3d") grid = {3, 3, size / 30, 24, 24, Perspective{0.09, 0.09}, 3};
    if (cuts_simplices(algorithm)) grid = {2, 2, size / 20, 8, 8, Perspective{0.03, 0.03}, 3};
    const SharedScene shaded = shaded_scene(scene, !crosses_plane(algorithm));
    const LightFieldBuffer rays = rendered("raytrace", shaded, grid), other = rendered(algorithm, shaded, grid);
    std::size_t compared = 0, hits = 0, different = 0;
    double worst = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t v = 0; v < grid.directions_v; ++v)
                for (std::size_t u = 0; u < grid.directions_u; ++u) {
                    if (near_silhouette(rays, t, s, v, u)) continue;
                    ++compared;
                    hits += std::isfinite(rays.depth(t, s, v, u)) ? 1 : 0;
                    double difference = 0;
                    for (std::size_t c = 0; c < 3; ++c)
                        difference = std::max(
                            difference, double(std::abs(rays.radiance(c, t, s, v, u) - other.radiance(c, t, s, v, u))));
                    worst = std::max(worst, difference);
                    different += difference > 1e-3;
                }
    EXPECT_EQ(different, 0u) << "of " << compared << ", the worst by " << worst;
    EXPECT_GT(hits, compared / 10);
    EXPECT_GT(compared, grid.hogels() * grid.directions() / 4);
}

}  // namespace
}  // namespace hogel::render
