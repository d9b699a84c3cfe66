// SPDX-License-Identifier: Apache-2.0
// Light fields with a fixed focal plane, from every renderer: directly, or through the projection of the scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "hogel/error.h"
#include "hogel/render/cache_spacing.h"
#include "hogel/render/projected.h"
#include "hogel/render/test_renderers.h"
#include "hogel/scene.h"
#include "hogel/shading/radiance_cache.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

LightFieldGrid grid_with(double focal_plane) {
    return {5, 4, 1_mm, 21, 19, FocalPlane{{0.5, 0.4, 0.03, -0.02}, focal_plane}, 3};
}

// Random triangles with radiance equal to position, so that a sample identifies the visible point.
ShadedScene triangles_that_show_where_they_are(unsigned seed, bool behind) {
    std::mt19937 random(seed);
    ShadedScene scene = random_scene(random, 24, behind);
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const Vec3& p = scene.positions[i];
        scene.radiance[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    }
    scene.background = {9, 9, 9};
    return scene;
}

class FocalPlanes : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, FocalPlanes, ::testing::ValuesIn(renderer_names()),
                         [](const auto& parameter) { return test_name(parameter.param); });

// The visible point of a sample is the point of its ray at its depth.
TEST_P(FocalPlanes, samples_see_points_of_the_rays_through_the_plane) {
    for (const double focal : {-60_mm, -15_mm, 12_mm, 400_mm}) {
        const LightFieldGrid grid = grid_with(focal);
        const ShadedScene scene = triangles_that_show_where_they_are(3, !crosses_plane(GetParam()));
        const LightFieldBuffer seen = render(GetParam(), scene, grid);
        // In the projection of small triangles radiance is interpolated as if they were not projected. The visible
        // point is off by at most a hundredth of a sample's width.
        const double tolerance = renderers().find(GetParam()).takes_focal_plane ? 2e-8 : 0.01 * grid.pitch;
        std::size_t hits = 0;
        for (std::size_t t = 0; t < grid.hogels_t; ++t)
            for (std::size_t s = 0; s < grid.hogels_s; ++s)
                for (std::size_t v = 0; v < grid.directions_v; ++v)
                    for (std::size_t u = 0; u < grid.directions_u; ++u) {
                        const double depth = seen.depth(t, s, v, u);
                        if (!std::isfinite(depth)) continue;
                        ++hits;
                        const double at_u = grid.u(double(u)) * focal, at_v = grid.v(double(v)) * focal;
                        const double share = depth / focal;  // of the way from the hogel to the focal plane
                        const double x = grid.s(double(s)) * (1 - share) + at_u * share,
                                     y = grid.t(double(t)) * (1 - share) + at_v * share;
                        ASSERT_NEAR(seen.radiance(0, t, s, v, u), x, tolerance) << focal;
                        ASSERT_NEAR(seen.radiance(1, t, s, v, u), y, tolerance) << focal;
                        ASSERT_NEAR(seen.radiance(2, t, s, v, u), -depth, tolerance) << focal;
                    }
        EXPECT_GT(hits, seen.depth.size() / 4) << focal;
    }
}

// Each hogel equals the hogel of a light field with its directions in all hogels.
TEST_P(FocalPlanes, every_hogel_is_that_of_its_own_directions) {
    const LightFieldGrid grid = grid_with(-25_mm);
    const ShadedScene scene = triangles_that_show_where_they_are(4, !crosses_plane(GetParam()));
    const LightFieldBuffer seen = render(GetParam(), scene, grid);
    std::size_t different = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s) {
            const LightFieldBuffer own = render(GetParam(), scene, grid.of_hogel(double(s), double(t)));
            for (std::size_t v = 0; v < grid.directions_v; ++v)
                for (std::size_t u = 0; u < grid.directions_u; ++u) {
                    const float a = seen.depth(t, s, v, u), b = own.depth(t, s, v, u);
                    different += a == b || std::abs(a - b) < 1e-8f ? 0 : 1;
                }
        }
    // Rounding decides about rays along edges.
    EXPECT_LE(different, renderers().find(GetParam()).takes_focal_plane ? 0 : seen.depth.size() / 1000);
}

TEST_P(FocalPlanes, far_away_are_a_perspective) {
    const ShadedScene scene = triangles_that_show_where_they_are(5, !crosses_plane(GetParam()));
    LightFieldGrid common = grid_with(1e9);
    common.view = Perspective{common.range()};
    const LightFieldBuffer expected = render(GetParam(), scene, common);
    for (const double focal : {1e9, -1e9}) {
        const LightFieldBuffer seen = render(GetParam(), scene, grid_with(focal));
        std::size_t different = 0;
        for (std::size_t i = 0; i < seen.radiance.size(); ++i)
            different += std::abs(seen.radiance.data()[i] - expected.radiance.data()[i]) < 1e-7f ? 0 : 1;
        EXPECT_LE(different, seen.radiance.size() / 1000);
    }
}

// Light is evaluated at the points of a cache or at vertices, as without a focal plane, not at every ray.
TEST(FocalPlane, light_is_evaluated_at_few_points) {
    const LightFieldGrid grid{24, 24, 0.5_mm, 48, 48, FocalPlane{{0.4, 0.4}, -300_mm}, 3};
    Scene ball = make_scene("sphere", 8_mm);
    const double back = bounds(ball).high.z + 1_mm;
    for (Mesh& mesh : ball.meshes)
        for (Vec3& position : mesh.positions) position.z -= back;
    for (const bool lit : {false, true}) {
        ShadedScene scene = shade_scene(ball, {.model = lit ? "shadowed" : "vertex"});
        const auto exact = std::make_shared<const ShadedScene>(scene);
        if (lit) shading::add_radiance_cache(scene, cache_spacing(scene, grid, 0.5));
        const auto cached = std::make_shared<const ShadedScene>(scene);
        const auto projected = projected_scene(cached, grid, "epi");
        const LightFieldBuffer expected = render("raytrace", exact, grid), seen = render("epi", cached, grid);
        const LightFieldBuffer again = render("epi", projected, projected_grid(grid));
        double error = 0, power = 0;
        std::size_t hits = 0;
        for (std::size_t i = 0; i < seen.radiance.size(); ++i) {
            error += std::pow(seen.radiance.data()[i] - expected.radiance.data()[i], 2);
            power += std::pow(expected.radiance.data()[i], 2);
        }
        for (const float depth : seen.depth.elements()) hits += std::isfinite(depth) ? 1 : 0;
        EXPECT_LT(error, 1e-3 * power) << lit;
        EXPECT_TRUE(std::ranges::equal(again.radiance.elements(), seen.radiance.elements()));
        EXPECT_GT(hits, grid.hogels() * grid.directions() / 10);
        ASSERT_EQ(projected->radiance_cache != nullptr, lit);
        if (lit) {
            EXPECT_GT(projected->radiance_cache->points_filled(), 100u);
            EXPECT_LT(projected->radiance_cache->points_filled(), hits / 4);
        } else {
            for (std::size_t i = 0; i < projected->triangles.size(); ++i)
                EXPECT_FALSE(projected->needs_samples(i)) << i;
        }
    }
}

// Hogels share the samples on the plane itself. Only points on the plane look the same from all hogels. Their
// projection is at infinity, so that only renderers that follow the rays can show them.
TEST_P(FocalPlanes, a_picture_on_the_plane_is_the_same_in_all_hogels) {
    const double focal = 8_mm;
    ShadedScene scene;
    const auto picture = [](Vec3 p) {
        return Rgb{static_cast<float>(0.5 + 50 * p.x), static_cast<float>(0.5 + 50 * p.y), 1};
    };
    add_triangle(scene, {-9e-3, -8e-3, -focal}, {9e-3, -8e-3, -focal}, {0, 9e-3, -focal}, picture);
    const LightFieldGrid grid = grid_with(focal);
    if (!renderers().find(GetParam()).takes_focal_plane) {
        try {
            render(GetParam(), scene, grid);
            ADD_FAILURE() << "was not refused";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_NE(std::string(error.what()).find("raytrace, zbuffer"), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("8 mm"), std::string::npos) << error.what();
        }
        return;
    }
    const LightFieldBuffer seen = render(GetParam(), scene, grid);
    std::size_t different = 0, hits = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t v = 0; v < grid.directions_v; ++v)
                for (std::size_t u = 0; u < grid.directions_u; ++u) {
                    hits += seen.radiance(2, t, s, v, u) == 1 ? 1 : 0;
                    for (std::size_t c = 0; c < 3; ++c)
                        different +=
                            std::abs(seen.radiance(c, t, s, v, u) - seen.radiance(c, 0, 0, v, u)) < 1e-5f ? 0 : 1;
                }
    EXPECT_LE(different, seen.radiance.size() / 1000);
    EXPECT_GT(hits, seen.depth.size() / 3);
}

// Resampled to common directions, the light field equals the one rendered in them, except at edges of triangles.
TEST(FocalPlane, resampled_is_nearly_the_light_field_rendered_in_directions_in_common) {
    ShadedScene scene;
    const auto smooth = [](Vec3 p) {
        return Rgb{static_cast<float>(0.5 + 60 * p.x), static_cast<float>(0.5 - 50 * p.y),
                   static_cast<float>(0.5 + 20 * p.z)};
    };
    add_triangle(scene, {-90e-3, -80e-3, -9e-3}, {90e-3, -80e-3, -9e-3}, {0, 90e-3, -9e-3}, smooth);
    add_triangle(scene, {-3e-3, -2e-3, -4e-3}, {3e-3, -2e-3, -5e-3}, {0, 3e-3, 2e-3}, smooth);
    LightFieldGrid grid{16, 12, 0.5_mm, 64, 60, FocalPlane{{0.3, 0.28}, -60_mm}, 3};
    const LightFieldBuffer through_plane = render("raytrace", scene, grid);
    const LightFieldGrid common = common_directions(grid);
    const LightFieldBuffer direct = render("raytrace", scene, common);
    LightFieldBuffer resampled(common, true);
    copy(with_common_directions(borrow(through_plane)).front(), resampled);
    double error = 0, peak = 0, depth_error = 0;
    std::size_t count = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s) {
            const LightFieldGrid own = grid.of_hogel(double(s), double(t));
            for (std::size_t v = 0; v < common.directions_v; ++v)
                for (std::size_t u = 0; u < common.directions_u; ++u) {
                    const bool inside = own.covers({common.u(double(u)), common.v(double(v)), 1});
                    if (!inside) {
                        ASSERT_EQ(resampled.radiance(0, t, s, v, u), 0);
                        ASSERT_EQ(resampled.depth(t, s, v, u), std::numeric_limits<float>::infinity());
                        continue;
                    }
                    for (std::size_t c = 0; c < 3; ++c) {
                        const double there = direct.radiance(c, t, s, v, u);
                        error += std::pow(resampled.radiance(c, t, s, v, u) - there, 2);
                        peak = std::max(peak, there);
                    }
                    depth_error += std::pow(resampled.depth(t, s, v, u) - direct.depth(t, s, v, u), 2);
                    count += 1;
                }
        }
    EXPECT_GT(count, direct.depth.size() * 7 / 10);
    const double psnr = 10 * std::log10(peak * peak * 3 * double(count) / error);
    RecordProperty("psnr_db", std::to_string(psnr));
    EXPECT_GT(psnr, 48);  // 50.5 dB
    EXPECT_LT(std::sqrt(depth_error / double(count)), 1e-3);
}

}  // namespace
}  // namespace hogel::render
