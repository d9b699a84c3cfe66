// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/radiance_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hogel/shading.h"
#include "hogel/shading/test_scenes.h"
#include "hogel/work/parallel.h"

namespace hogel::shading {
namespace {

using Weights = std::array<float, 3>;

// Light of a known form that counts evaluations.
class KnownLight final : public SampleLighting {
  public:
    explicit KnownLight(double wave) : wave_(wave) {}
    Size size_of_light(std::size_t) const override { return {2, 5}; }
    bool light_is_radiance(std::size_t) const override { return false; }
    void light_on(const ShadedScene& scene, std::size_t index, const Weights& weights,
                  std::span<float> light) const override {
        ++evaluations;
        const auto& [a, b, c] = scene.triangles[index].vertices;
        const Vec3 p = double{weights[0]} * scene.positions[a] + double{weights[1]} * scene.positions[b] +
                       double{weights[2]} * scene.positions[c];
        light[0] = static_cast<float>(5 + 2 * p.x - p.y + 0.5 * p.z);
        light[1] = static_cast<float>(1 + 0.9 * std::sin(wave_ * p.x));
        for (std::size_t i = 0; i < 5; ++i) light[2 + i] = static_cast<float>(0.5 + 0.1 * double(i) * p.y);
    }
    Rgb radiance(const ShadedScene&, std::size_t, const Weights&, std::span<const float> light, Rgb,
                 const ViewSample&) const override {
        return {light[0], light[1], light[6]};
    }

    mutable std::atomic<std::size_t> evaluations = 0;

  private:
    double wave_;
};

// A large triangle, slivers whose shortest side is each of the three, and two triangles without area.
ShadedScene triangles() {
    ShadedScene scene;
    scene.positions = {{-1, -1, 0}, {1, -0.9, 0.2}, {0.1, 1, -0.3}, {-0.99, -1, 0}, {0.1, 1.01, -0.3}};
    for (const std::array<std::uint32_t, 3>& corners :
         {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 3, 2}, {2, 0, 3}, {1, 2, 4}, {0, 0, 0}, {1, 2, 1}})
        scene.triangles.push_back({corners, ShadedScene::no_texture, 0});
    scene.radiance.resize(scene.positions.size());
    scene.texture_coordinates.resize(scene.positions.size());
    return scene;
}

Weights random_weights(std::mt19937& engine) {
    std::uniform_real_distribution<float> part(0, 1);
    float b = part(engine), c = part(engine);
    if (b + c > 1) b = 1 - b, c = 1 - c;
    return {1 - b - c, b, c};
}

TEST(RadianceCache, is_exact_for_linear_light_and_of_second_order_for_a_wave) {
    constexpr double wave = 9;
    for (const float spacing : {0.1f, 0.05f}) {
        ShadedScene scene = triangles();
        const auto light = std::make_shared<KnownLight>(wave);
        scene.lighting = light;
        add_radiance_cache(scene, std::vector<float>(scene.triangles.size(), spacing));
        std::mt19937 engine(1);
        for (int i = 0; i < 6000; ++i) {
            const std::size_t index = engine() % scene.triangles.size();
            const Weights w = random_weights(engine);
            const Rgb seen = radiance_at(scene, index, w[0], w[1], w[2]);
            std::array<float, 7> exact;
            light->light_on(scene, index, w, exact);
            // A sliver has a single column of points, at most half of its width away.
            const double offset = index == 0 ? 0 : 0.5 * 0.015;
            ASSERT_NEAR(seen.r, exact[0], 2.3 * offset + 2e-6) << index;
            ASSERT_NEAR(seen.b, exact[6], 0.4 * offset + 1.25 * 1.25 * 0.5 / 255 + 1e-6) << index;  // a share is a byte
            // The error is at most h²/8 f″ along each of the two axes of the grid, and a little more up to a quarter of
            // a cell beyond the outermost points.
            ASSERT_NEAR(seen.g, exact[1], 0.9 * (offset * wave + 2 * 1.25 * spacing * spacing / 8 * wave * wave) + 1e-6)
                << index;
        }
        EXPECT_LT(scene.radiance_cache->points_filled(), spacing == 0.1f ? 600u : 2000u);
    }
}

TEST(RadianceCache, gives_the_same_bits_in_any_order_and_number_of_threads) {
    ShadedScene once = triangles(), again = triangles();
    const std::vector<float> spacing(once.triangles.size(), 0.06f);
    for (ShadedScene* scene : {&once, &again}) {
        scene->lighting = std::make_shared<KnownLight>(20);
        add_radiance_cache(*scene, spacing);
    }
    constexpr std::size_t count = 20000;
    std::vector<Rgb> alone(count), together(count);
    const auto evaluate = [&](const ShadedScene& scene, std::size_t i) {
        std::mt19937 engine(static_cast<unsigned>(i));
        const std::size_t index = engine() % scene.triangles.size();
        const Weights w = random_weights(engine);
        return radiance_at(scene, index, w[0], w[1], w[2]);
    };
    for (std::size_t i = 0; i < count; ++i) alone[i] = evaluate(once, i);
    work::parallel_for(count, [&](std::size_t i) { together[count - 1 - i] = evaluate(again, count - 1 - i); });
    EXPECT_EQ(alone, together);
}

TEST(RadianceCache, evaluates_light_for_each_ray_where_a_triangle_has_no_grid) {
    ShadedScene scene = triangles(), plain = triangles();
    const auto light = std::make_shared<KnownLight>(5);
    scene.lighting = plain.lighting = light;
    std::vector<float> spacing(scene.triangles.size(), 0.1f);
    add_radiance_cache(scene, spacing);
    const double all = scene.radiance_cache->bytes();
    EXPECT_EQ(scene.radiance_cache->uncached_triangles(), 0u);
    spacing[1] = 0;  // no grid requested
    spacing[2] = 1e-30f;
    add_radiance_cache(scene, spacing, 0.75 * all);
    EXPECT_LE(scene.radiance_cache->bytes(), 0.75 * all);
    EXPECT_GE(scene.radiance_cache->uncached_triangles(), 1u);
    for (const std::size_t index : {1, 2}) {
        const Rgb seen = radiance_at(scene, index, 0.2f, 0.7f, 0.1f);
        EXPECT_EQ(seen, radiance_at(plain, index, 0.2f, 0.7f, 0.1f));
    }
    EXPECT_EQ(scene.radiance_cache->points_filled(), 0u);
    // A scene without lighting gets no cache.
    ShadedScene given = triangles();
    add_radiance_cache(given, spacing);
    EXPECT_EQ(given.radiance_cache, nullptr);
}

// A triangle with sides no longer than the spacing has one point, in its middle.
TEST(RadianceCache, lights_a_small_triangle_at_one_point) {
    ShadedScene scene = triangles();
    const auto light = std::make_shared<KnownLight>(5);
    scene.lighting = light;
    add_radiance_cache(scene, std::vector<float>(scene.triangles.size(), 2.4f));
    std::array<float, 7> middle;
    light->light_on(scene, 0, {1.0f / 3, 1.0f / 3, 1.0f / 3}, middle);
    for (const Weights& w : {Weights{1, 0, 0}, Weights{0, 0.5f, 0.5f}, Weights{0.2f, 0.3f, 0.5f}}) {
        EXPECT_NEAR(radiance_at(scene, 0, w[0], w[1], w[2]).r, middle[0], 2e-6);
        EXPECT_EQ(scene.radiance_cache->points_filled(), 1u);
    }
}

// A floor, matt or glossy and half metallic, a roof over part of it, and two lamps.
TEST(RadianceCache, is_accurate_away_from_the_edges_of_shadows) {
    for (const char* model : {"direct", "shadowed"})
        for (const float metallic : {0.0f, 0.5f}) {
            Scene scene;
            scene.meshes = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.8f, 0.4f, 1}),
                            square({0.2, 0.1, 0.5}, {0.3, 0, 0}, {0, 0.2, 0})};
            if (metallic > 0) {
                scene.meshes[0].material.reflectance = 0.04f;
                scene.meshes[0].material.metallic = metallic;
                scene.meshes[0].material.roughness = 0.4f;
            }
            scene.meshes[0].material.emission = {0.05f, 0, 0};
            scene.lights = {lamp({0.1, 0, 2}, 3), lamp({-1, 0.5, 1}, 2)};
            scene.lights[1].casts_shadows = false;
            scene.ambient = {0.1f, 0.1f, 0.1f};
            ShadingOptions options;
            options.model = model;
            options.shadow_map = 256;
            const ShadedScene plain = shade_scene(scene, options);
            ShadedScene cached = plain;
            add_radiance_cache(cached, std::vector<float>(plain.triangles.size(), 0.01f));
            std::mt19937 engine(3);
            std::size_t dark = 0;
            for (int i = 0; i < 4000; ++i) {
                const std::size_t index = engine() % 2;
                const Weights w = random_weights(engine);
                const auto& [a, b, c] = plain.triangles[index].vertices;
                const Vec3 p = double{w[0]} * plain.positions[a] + double{w[1]} * plain.positions[b] +
                               double{w[2]} * plain.positions[c];
                const Vec3 through = p + 0.25 * (scene.lights[0].position - p);
                const double edge = std::max(std::abs(through.x - 0.2) - 0.3, std::abs(through.y - 0.1) - 0.2);
                if (std::abs(edge) < 0.025) continue;
                dark += edge < 0 ? 1 : 0;
                const ViewSample view{normalize(Vec3{0.3, -0.5, 1}), 0.01};
                const Rgb truth = radiance_at(plain, index, w[0], w[1], w[2], view);
                const Rgb seen = radiance_at(cached, index, w[0], w[1], w[2], view);
                ASSERT_NEAR(seen.r, truth.r, 1e-3 * truth.r) << p.x << " " << p.y;
                ASSERT_NEAR(seen.b, truth.b, 1e-3 * truth.b) << p.x << " " << p.y;
            }
            EXPECT_GT(dark, 100u);
            EXPECT_GT(cached.radiance_cache->points_filled(), 1000u);
        }
}

}  // namespace
}  // namespace hogel::shading
