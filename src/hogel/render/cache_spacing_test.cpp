// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/cache_spacing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "hogel/renderer.h"
#include "hogel/shading.h"
#include "hogel/shading/radiance_cache.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel::render {
namespace {

using namespace literals;

// Wraps a lighting and counts the points at which it is evaluated.
class Counted final : public SampleLighting {
  public:
    explicit Counted(std::shared_ptr<const SampleLighting> inner) : inner_(std::move(inner)) {}
    Size size_of_light(std::size_t mesh) const override { return inner_->size_of_light(mesh); }
    bool light_is_radiance(std::size_t mesh) const override { return inner_->light_is_radiance(mesh); }
    void light_on(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                  std::span<float> light) const override {
        ++points;
        inner_->light_on(scene, index, weights, light);
    }
    Rgb radiance(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                 std::span<const float> light, Rgb texture, const ViewSample& view) const override {
        return inner_->radiance(scene, index, weights, light, texture, view);
    }

    mutable std::atomic<std::size_t> points = 0;

  private:
    std::shared_ptr<const SampleLighting> inner_;
};

constexpr std::array background{0.01f, 0.02f, 0.03f};
const LightFieldGrid grid{30, 24, 0.2_mm, 28, 28, Perspective{0.35, 0.35}, 3};

Mesh quad(Vec3 middle, Vec3 right, Vec3 up) {
    Mesh mesh;
    mesh.positions = {middle - right - up, middle + right - up, middle + right + up, middle - right + up};
    mesh.normals.assign(4, normalize(cross(right, up)));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

// A tilted wall that crosses the hologram plane, a glossy board that casts shadows on it, and twelve lamps.
Scene lit_wall() {
    Scene scene;
    scene.meshes = {quad({0, 0, -4e-3}, {4e-3, 0, 2e-3}, {0, 4e-3, 3e-3}),
                    quad({0.3e-3, 0.2e-3, -1.5e-3}, {0.9e-3, 0, 0}, {0, 0.6e-3, 0})};
    scene.meshes[1].material.reflectance = 0.04f;
    scene.meshes[1].material.roughness = 0.4f;
    for (int i = 0; i < 12; ++i) {
        Light light;
        light.kind = Light::Kind::point;
        const int row = i / 4;
        light.position = {(i % 4 - 1.5) * 4e-3, (row - 1.0) * 4e-3, 15e-3};
        light.intensity = {1e-5f, 1.2e-5f, 0.8e-5f};
        scene.lights.push_back(light);
    }
    scene.ambient = {0.05f, 0.05f, 0.05f};
    scene.background = {background[0], background[1], background[2]};
    return scene;
}

std::shared_ptr<ShadedScene> shaded(const char* model, double share, std::shared_ptr<Counted>* counted = nullptr) {
    ShadingOptions options;
    options.model = model;
    options.shadow_map = 256;
    auto scene = std::make_shared<ShadedScene>(shade_scene(lit_wall(), options));
    const auto lighting = std::make_shared<Counted>(scene->lighting);
    scene->lighting = lighting;
    if (counted) *counted = lighting;
    if (share > 0) shading::add_radiance_cache(*scene, cache_spacing(*scene, grid, share));
    return scene;
}

LightFieldBuffer render(const std::shared_ptr<const ShadedScene>& scene, std::string_view algorithm = "epi") {
    LightFieldBuffer light_field(grid);
    copy(*make_renderer(algorithm, scene, grid), light_field);
    return light_field;
}

TEST(CacheSpacing, is_the_smallest_width_of_a_sample_on_the_triangle) {
    const ShadedScene scene = shade_scene_vertices(lit_wall());
    const std::vector<float> spacing = cache_spacing(scene, grid, 0.5);
    ASSERT_EQ(spacing.size(), 4u);
    EXPECT_FLOAT_EQ(spacing[0], 0.5f * 0.2e-3f);  // crosses the hologram plane
    EXPECT_FLOAT_EQ(spacing[2], 0.5f * 0.2e-3f);  // 1.5 mm · 0.025 is less than a hogel
    const LightFieldGrid fine{24, 20, 0.02_mm, 24, 24, Perspective{0.3, 0.3}, 3};
    EXPECT_FLOAT_EQ(cache_spacing(scene, fine, 2)[2], 2 * 1.5e-3f * 0.025f);
}

// The cache changes radiance only at the edges of shadows, and evaluates light at a twentieth of the points.
TEST(CacheSpacing, keeps_radiance_away_from_the_edges_of_shadows) {
    for (const char* model : {"direct", "shadowed"}) {
        std::shared_ptr<Counted> counted;
        const LightFieldBuffer truth = render(shaded(model, 0)), seen = render(shaded(model, 0.5, &counted));
        double error = 0, power = 0;
        std::size_t off = 0, lit = 0;
        for (std::size_t i = 0; i < truth.radiance.size(); ++i) {
            const double expected = truth.radiance.data()[i], difference = seen.radiance.data()[i] - expected;
            error += difference * difference;
            power += expected * expected;
            off += std::abs(difference) > 0.01 * expected ? 1 : 0;
            lit += truth.radiance.data()[i] != background[i / (truth.radiance.size() / 3)] ? 1 : 0;
        }
        EXPECT_LT(std::sqrt(error / power), 0.004);  // 48 dB
        EXPECT_LT(double(off) / double(truth.radiance.size()), 0.08);
        EXPECT_GT(off, 0u);
        const std::size_t rays = lit / 3;
        EXPECT_GT(rays, grid.hogels() * grid.directions() / 2);
        EXPECT_GT(rays, 20 * counted->points);
    }
}

TEST(CacheSpacing, gives_the_same_bytes_for_any_tiling_and_number_of_threads) {
    const LightFieldBuffer many = render(shaded("direct", 0.5));
    LightFieldBuffer tiled(grid);
    {
        const ThreadLimit one(1);
        const auto source = make_renderer("epi", shaded("direct", 0.5), grid);
        for (std::size_t t = grid.hogels_t; t-- > 0;)
            for (std::size_t s = 0; s < grid.hogels_s; s += 10) {
                LightFieldTile tile(grid, {s, t, 10, 1}, false);
                source->read(tile);
                tiled.write(tile);
            }
    }
    EXPECT_TRUE(std::ranges::equal(many.radiance.elements(), tiled.radiance.elements()));
    const LightFieldBuffer traced = render(shaded("direct", 0.5), "raytrace");
    // Other renderers give nearly the same. At shadow edges epi differs, because it interpolates between knots.
    std::size_t off = 0, far_off = 0;
    for (std::size_t i = 0; i < traced.radiance.size(); ++i) {
        const double expected = traced.radiance.data()[i], difference = many.radiance.data()[i] - expected;
        off += std::abs(difference) > 1e-3 * expected ? 1 : 0;
        far_off += std::abs(difference) > 1e-2 * expected ? 1 : 0;
    }
    EXPECT_LT(double(off) / double(traced.radiance.size()), 0.04);
    EXPECT_LT(double(far_off) / double(traced.radiance.size()), 0.001);
}

}  // namespace
}  // namespace hogel::render
