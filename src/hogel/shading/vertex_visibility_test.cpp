// SPDX-License-Identifier: Apache-2.0
// Edges of shadows, lit at the vertices of a mesh.
#include "hogel/shading/vertex_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hogel/scene.h"
#include "hogel/shading/test_scenes.h"

namespace hogel::shading {
namespace {

/// A level floor of n × n squares from −1 to 1 under a half-plane. In light from the front, its shadow has an edge
/// through the middle that rises by `slope`.
Scene floor_in_shadow(std::uint32_t n, double slope) {
    Scene scene;
    Mesh floor;
    for (std::uint32_t row = 0; row <= n; ++row)
        for (std::uint32_t column = 0; column <= n; ++column)
            floor.positions.push_back({-1 + 2.0 * column / n, -1 + 2.0 * row / n, 0});
    floor.normals.assign(floor.positions.size(), {0, 0, 1});
    for (std::uint32_t row = 0; row < n; ++row)
        for (std::uint32_t column = 0; column < n; ++column) {
            const std::uint32_t a = row * (n + 1) + column, b = a + 1, c = a + n + 1, d = c + 1;
            floor.triangles.push_back({a, b, d});
            floor.triangles.push_back({a, d, c});
        }
    Mesh blocker;
    blocker.positions = {{-2, -2 * slope, 0.5}, {2, 2 * slope, 0.5}, {2, 4, 0.5}, {-2, 4, 0.5}};
    blocker.normals.assign(4, {0, 0, 1});
    blocker.triangles = {{0, 1, 2}, {0, 2, 3}};
    for (Mesh* mesh : {&floor, &blocker}) mesh->material.base_color = {1, 1, 1};
    scene.meshes = {floor, blocker};
    Light light;
    light.direction = {0, 0, -1};
    light.intensity = {1, 1, 1};
    scene.lights = {light};
    return scene;
}

/// Returns the interpolated value of a renderer at a point of the floor.
double interpolated(const std::vector<float>& values, std::uint32_t n, double x, double y) {
    const double column = (x + 1) * n / 2, row = (y + 1) * n / 2;
    const auto i = static_cast<std::uint32_t>(column), k = static_cast<std::uint32_t>(row);
    const double u = column - i, v = row - k;
    const auto at = [&](std::uint32_t di, std::uint32_t dk) { return double{values[(k + dk) * (n + 1) + i + di]}; };
    return u > v ? (1 - u) * at(0, 0) + (u - v) * at(1, 0) + v * at(1, 1)
                 : (1 - v) * at(0, 0) + (v - u) * at(0, 1) + u * at(1, 1);
}

/// Largest difference of light along lines beside the edge, where it should be constant, and the mean light.
std::pair<double, double> stairs(const std::vector<float>& values, std::uint32_t n, double slope) {
    double worst = 0, sum = 0;
    int count = 0;
    for (double aside = -0.08; aside < 0.081; aside += 0.01) {
        double low = 1, high = 0;
        for (double x = -0.5; x < 0.5; x += 0.003) {
            const double value = interpolated(values, n, x, slope * x + aside);
            low = std::min(low, value), high = std::max(high, value), sum += value, ++count;
        }
        worst = std::max(worst, high - low);
    }
    return {worst, sum / count};
}

TEST(VertexVisibility, edges_of_shadows_are_straight_and_where_they_belong) {
    constexpr std::uint32_t n = 24;
    for (const double slope : {0.13, 0.37, 0.71}) {
        const Scene scene = floor_in_shadow(n, slope);
        const ShadedScene shaded = shade_scene(scene, {.model = "vertex"});
        std::vector<float> light, by_corners;
        for (const Vec3& p : scene.meshes[0].positions) {
            light.push_back(shaded.radiance[light.size()].r * 3.14159265f);
            by_corners.push_back(p.y < slope * p.x ? 1.0f : 0.0f);
        }
        const auto [smooth, mean] = stairs(light, n, slope);
        const auto [steps, unused] = stairs(by_corners, n, slope);
        EXPECT_GT(steps, 0.6) << slope;  // with rays at corners only
        EXPECT_LT(smooth, 0.3) << slope;
        EXPECT_NEAR(mean, 0.5, 0.02) << slope;
    }
}

// Needs no further rays.
TEST(VertexVisibility, of_fine_meshes_and_away_from_edges_is_that_of_a_ray) {
    for (const std::uint32_t n : {24u, 300u}) {
        const Scene scene = floor_in_shadow(n, 0.37);
        const ShadedScene shaded = shade_scene(scene, {.model = "vertex"});
        const double near = n == 24 ? 3.0 / n : 1e-9;
        for (std::size_t i = 0; i < scene.meshes[0].positions.size(); ++i) {
            const Vec3 p = scene.meshes[0].positions[i];
            const double aside = p.y - 0.37 * p.x;
            if (std::abs(aside) <= near) continue;
            ASSERT_NEAR(shaded.radiance[i].r * 3.14159265f, aside < 0 ? 1 : 0, 1e-6) << n << " " << aside;
        }
    }
}

// Each of many lights is a small part of the total, and its stairs need no smoothing.
TEST(VertexVisibility, of_many_lights_is_that_of_rays) {
    Scene scene = floor_in_shadow(24, 0.37);
    scene.lights.resize(5, scene.lights[0]);
    const ShadedScene shaded = shade_scene(scene, {.model = "vertex"});
    for (std::size_t i = 0; i < scene.meshes[0].positions.size(); ++i) {
        const Vec3 p = scene.meshes[0].positions[i];
        if (std::abs(p.y - 0.37 * p.x) < 1e-9) continue;
        ASSERT_NEAR(shaded.radiance[i].r * 3.14159265f, p.y < 0.37 * p.x ? 5 : 0, 1e-5);
    }
}

TEST(VertexVisibility, of_a_light_without_shadows_is_whole_on_fronts) {
    Scene scene = floor_in_shadow(24, 0.37);
    scene.lights[0].casts_shadows = false;
    const ShadedScene shaded = shade_scene(scene, {.model = "vertex"});
    for (const Rgb& radiance : shaded.radiance) EXPECT_NEAR(radiance.r * 3.14159265f, 1, 1e-6);
}

}  // namespace
}  // namespace hogel::shading
