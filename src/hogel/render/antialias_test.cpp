// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "hogel/error.h"
#include "hogel/render/test_renderers.h"
#include "hogel/resources.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

constexpr double depth = 6e-3;
const LightFieldGrid grid{6, 3, 1_mm, 12, 10, Perspective{0.4, 0.3}, 3};

// A wall behind the hologram made of vertical stripes, each from one x to the next.
ShadedScene wall(const std::vector<double>& x, const std::function<Rgb(Vec3)>& radiance) {
    ShadedScene scene;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        const Vec3 a{x[i], -0.1, -depth}, b{x[i + 1], -0.1, -depth}, c{x[i + 1], 0.1, -depth}, d{x[i], 0.1, -depth};
        add_triangle(scene, a, b, c, radiance);
        add_triangle(scene, a, c, d, radiance);
    }
    return scene;
}

TEST(SamplesPerRay, keep_a_constant_exactly) {
    const ShadedScene scene = wall({-0.1, 0.1}, white);
    ShadedScene tinted = scene;
    tinted.background = {0.1f, 0.7f, 1.0f / 3};
    tinted.triangles.clear();
    for (const SamplesPerRay samples : {SamplesPerRay{1, 1}, {2, 2}, {3, 1}, {1, 5}, {3, 3}}) {
        const LightFieldBuffer background = render("epi", tinted, grid, samples),
                               seen = render("epi", scene, grid, samples);
        for (float value : background.radiance[0].elements()) ASSERT_EQ(value, tinted.background.r);
        for (float value : background.radiance[2].elements()) ASSERT_EQ(value, tinted.background.b);
        for (float value : background.depth.elements()) ASSERT_EQ(value, std::numeric_limits<float>::infinity());
        for (float value : seen.radiance.elements()) ASSERT_NEAR(value, 1, 1e-6);
        for (float value : seen.depth.elements()) ASSERT_NEAR(value, depth, 1e-8);
    }
}

// A wave on the wall is attenuated by sinc(f d) over the width of the hogel and by sinc(f ζ ΔU) over the cell of the
// direction. With n samples instead of a continuous box, sinc(x) becomes sin(πx)/(n sin(πx/n)).
TEST(SamplesPerRay, attenuate_a_wave_as_a_box_does) {
    constexpr double pi = std::numbers::pi;
    std::vector<double> x;
    for (int i = -800; i <= 800; ++i) x.push_back(i * 12.5e-6);
    for (const double frequency : {150.0, 420.0, 700.0}) {
        const ShadedScene scene = wall(x, [&](Vec3 p) {
            const auto value = static_cast<float>(std::sin(2 * pi * frequency * p.x));
            return Rgb{value, value, value};
        });
        for (const SamplesPerRay samples : {SamplesPerRay{4, 4}, {1, 8}, {8, 1}}) {
            const auto factor = [&](double width, std::size_t n) {
                const double a = pi * frequency * width;
                return std::sin(a) / (double(n) * std::sin(a / double(n)));
            };
            const double left = factor(grid.pitch, samples.hogel) * factor(depth * grid.step_u(), samples.direction);
            const LightFieldBuffer seen = render("epi", scene, grid, samples);
            double error = 0;
            for (std::size_t s = 0; s < grid.hogels_s; ++s)
                for (std::size_t u = 0; u < grid.directions_u; ++u) {
                    const double at = grid.s(double(s)) + depth * grid.u(double(u));
                    const double expected = left * std::sin(2 * pi * frequency * at);
                    error = std::max(error, std::abs(seen.radiance(1, 1, s, 4, u) - expected));
                }
            EXPECT_LT(error, 1e-3) << frequency << " " << samples.hogel << "x" << samples.direction;
            if (samples.hogel == 4) {
                const auto sinc = [&](double width) {
                    return std::sin(pi * frequency * width) / (pi * frequency * width);
                };
                EXPECT_NEAR(left, sinc(grid.pitch) * sinc(depth * grid.step_u()), 0.03) << frequency;
            }
        }
    }
}

// The share of a ray's cell left of an edge is an integral over the boxes of s and of ζU.
TEST(SamplesPerRay, give_the_covered_share_of_a_silhouette_to_one_sample) {
    for (const double edge : {-0.21e-3, 0.077e-3, 0.34e-3}) {
        const ShadedScene scene = wall({-0.1, edge}, white);
        for (const std::size_t n : {2, 4, 7}) {
            const LightFieldBuffer seen = render("zbuffer", scene, grid, {n, n});
            std::size_t partial = 0;
            for (std::size_t s = 0; s < grid.hogels_s; ++s)
                for (std::size_t u = 0; u < grid.directions_u; ++u) {
                    const double middle = grid.s(double(s)) + depth * grid.u(double(u));
                    constexpr int steps = 400;
                    double covered = 0;
                    for (int i = 0; i < steps; ++i) {
                        const double at = middle + depth * grid.step_u() * ((i + 0.5) / steps - 0.5);
                        covered += std::clamp((edge - at) / grid.pitch + 0.5, 0.0, 1.0) / steps;
                    }
                    const float value = seen.radiance(0, 2, s, 3, u);
                    ASSERT_NEAR(value, covered, 1.0 / double(n)) << edge << " " << n;
                    partial += value > 0 && value < 1 ? 1 : 0;
                    // A ray that shows any part of the wall has the wall's depth.
                    ASSERT_EQ(std::isfinite(seen.depth(2, s, 3, u)), value > 0);
                }
            EXPECT_GT(partial, 5u);
        }
    }
}

ShadedScene two_triangles() {
    ShadedScene scene;
    scene.background = {0.2f, 0.1f, 0.3f};
    const auto colour = [](Vec3 p) { return Rgb{float(0.5 + 90 * p.x), float(0.5 - 60 * p.y), 0.8f}; };
    add_triangle(scene, {-3e-3, -2e-3, -3e-3}, {3e-3, -1e-3, -5e-3}, {0, 2.5e-3, -2e-3}, colour);
    add_triangle(scene, {-2e-3, 2e-3, -9e-3}, {4e-3, 1e-3, -4e-3}, {1e-3, -3e-3, -7e-3}, colour);
    return scene;
}

TEST(SamplesPerRay, agree_between_renderers) {
    const SamplesPerRay samples{2, 3};
    const LightFieldBuffer truth = render("raytrace", two_triangles(), grid, samples);
    const LightFieldBuffer once = render("raytrace", two_triangles(), grid, {1, 1});
    double smoothed = 0;
    for (std::size_t i = 0; i < truth.radiance.size(); ++i)
        smoothed = std::max<double>(smoothed, std::abs(truth.radiance.data()[i] - once.radiance.data()[i]));
    EXPECT_GT(smoothed, 0.1);
    for (const RendererInfo& info : renderers().rows()) {
        const LightFieldBuffer seen = render(info.name, two_triangles(), grid, samples);
        double sum = 0, worst = 0;
        for (std::size_t i = 0; i < seen.radiance.size(); ++i) {
            const double error = std::abs(seen.radiance.data()[i] - truth.radiance.data()[i]);
            sum += error;
            worst = std::max(worst, error);
        }
        EXPECT_LT(sum / double(seen.radiance.size()), 1e-4) << info.name;
        EXPECT_LT(worst, 3.0 / double(samples.count())) << info.name;  // rounding decides for rays through an edge
    }
}

TEST(SamplesPerRay, give_the_same_bytes_for_any_tiling_and_number_of_threads) {
    const SamplesPerRay samples{3, 2};
    const auto scene = std::make_shared<const ShadedScene>(two_triangles());
    LightFieldBuffer single(grid, true);
    {
        const ThreadLimit one(1);
        copy(*make_renderer("epi", scene, grid, samples), single);
    }
    const auto source = make_renderer("epi", scene, grid, samples);
    for (const HogelRange& range : {HogelRange{0, 0, 1, 1}, HogelRange{2, 1, 3, 2}, HogelRange{0, 2, 6, 1},
                                    HogelRange{5, 0, 1, 3}, HogelRange{0, 0, 6, 3}}) {
        LightFieldTile tile(grid, range, true), expected(grid, range, true);
        source->read(tile);
        single.read(expected);
        EXPECT_TRUE(std::ranges::equal(tile.radiance.elements(), expected.radiance.elements()));
        EXPECT_TRUE(std::ranges::equal(tile.depth.elements(), expected.depth.elements()));
    }
}

TEST(SamplesPerRay, divide_the_cells_of_every_face) {
    for (const LightFieldGrid& face : hemicube({4, 3, 1_mm, 8, 6, Perspective{1, 1}, 3})) {
        const LightFieldGrid fine = finer(face, {3, 2});
        EXPECT_NEAR(fine.s(3 * 2 + 1), face.s(2), 1e-15);
        EXPECT_NEAR(fine.t(3 * 1 + 1), face.t(1), 1e-15);
        EXPECT_NEAR(0.5 * (fine.u(6) + fine.u(7)), face.u(3), 1e-15);
        EXPECT_NEAR(0.5 * (fine.v(2) + fine.v(3)), face.v(1), 1e-15);
    }
    for (const SamplesPerRay samples : {SamplesPerRay{0, 1}, {1, 0}, {65, 1}, {1, std::size_t{1} << 40}})
        EXPECT_THROW(finer(grid, samples), Error);
    EXPECT_THROW(average(std::make_unique<LightFieldBuffer>(grid), grid, {2, 1}), Error);
}

}  // namespace
}  // namespace hogel::render
