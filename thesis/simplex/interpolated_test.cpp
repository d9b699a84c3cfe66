// SPDX-License-Identifier: Apache-2.0
// Interpolation in four dimensions ([K] 5.5 to 5.7) against `simplex`, which computes every sample from its ray.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hogel/error.h"
#include "hogel/render/layers.h"
#include "hogel/render/test_renderers.h"
#include "hogel/render/visits.h"
#include "hogel/units.h"

namespace hogel::simplex {

using namespace render;

namespace {

using namespace literals;

const LightFieldGrid grid{9, 7, 0.4_mm, 33, 31, Perspective{0.5, 0.4}, 3};

LightFieldBuffer interpolated(const std::shared_ptr<const ShadedScene>& scene, std::size_t region,
                              const LightFieldGrid& sampled = grid) {
    LightFieldBuffer light_field(sampled, true);
    copy(*make_interpolating_renderer(scene, sampled, region), light_field);
    return light_field;
}

// Triangles of a tilted plane with radiance linear in space, and a card in front of it.
std::shared_ptr<ShadedScene> planes() {
    const auto radiance = [](Vec3 p) {
        return Rgb{float(0.5 + 40 * p.x), float(0.5 - 30 * p.y), float(0.5 + 50 * p.z)};
    };
    auto scene = std::make_shared<ShadedScene>();
    const auto plane = [](double x, double y) { return Vec3{x, y, 0.3 * x - 0.2 * y - 7e-3}; };
    const double e = 12e-3;
    const std::array corners{plane(-e, -e), plane(e, -e), plane(e, e), plane(-e, e)};
    for (std::size_t i = 0; i < 4; ++i)
        add_triangle(*scene, plane(1e-3, -0.7e-3), corners[i], corners[(i + 1) % 4], radiance);
    add_triangle(*scene, {-1.1e-3, -1e-3, -2.1e-3}, {1.2e-3, -0.9e-3, -2.4e-3}, {0.2e-3, 1.3e-3, -2.2e-3}, radiance);
    scene->background = {9, 9, 9};
    return scene;
}

struct Difference {
    std::size_t other_triangle = 0, samples = 0;
    double worst = 0, worst_depth = 0;
};

Difference difference(const LightFieldBuffer& a, const LightFieldBuffer& b) {
    Difference result;
    for (std::size_t i = 0; i < a.depth.size(); ++i) {
        ++result.samples;
        const float p = a.depth.data()[i], q = b.depth.data()[i];
        if (std::isinf(p) != std::isinf(q) || std::abs(p - q) > 1e-5) {
            ++result.other_triangle;
            continue;
        }
        if (std::isfinite(p)) result.worst_depth = std::max(result.worst_depth, double(std::abs(p - q)));
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = c * a.depth.size() + i;
            result.worst = std::max(result.worst, double(std::abs(a.radiance.data()[at] - b.radiance.data()[at])));
        }
    }
    return result;
}

// [K] 5.5: Q, and values multiplied by it, are linear in the projected volume, so radiance at vertices is interpolated
// to what a ray sees.
TEST(Interpolated, equals_simplex_where_radiance_is_given_at_vertices) {
    const auto scene = planes();
    const LightFieldBuffer exact = render::render("simplex", std::shared_ptr<const ShadedScene>(scene), grid);
    for (const std::size_t region : {1, 3, 4, 9}) {
        const Difference seen = difference(exact, interpolated(scene, region));
        EXPECT_LE(seen.other_triangle, 2u) << region;  // on edges
        EXPECT_LT(seen.worst, 2e-5) << region;
        EXPECT_LT(seen.worst_depth, 1e-8) << region;
    }
}

TEST(Interpolated, finds_the_samples_of_random_triangles_from_both_sides) {
    std::mt19937 random(5);
    for (int round = 0; round < 4; ++round) {
        auto scene = std::make_shared<ShadedScene>(random_scene(random, 16, true));
        scene->fronts_only = round % 2 == 1;
        const LightFieldBuffer exact = render::render("simplex", std::shared_ptr<const ShadedScene>(scene), grid);
        const Difference seen = difference(exact, interpolated(scene, 4));
        // Triangles that are thinner than rounding, and silhouettes through samples.
        EXPECT_LE(double(seen.other_triangle), 2e-3 * double(seen.samples)) << round;
    }
}

// Light that depends on the viewer, as |n·v| does, is exact at the corners of a region and interpolated between them.
class Slanted final : public SampleLighting {
  public:
    Size size_of_light(std::size_t) const override { return {3, 0}; }
    bool light_is_radiance(std::size_t) const override { return false; }
    void light_on(const ShadedScene&, std::size_t, const std::array<float, 3>&, std::span<float> light) const override {
        light[0] = light[1] = light[2] = 1;
    }
    Rgb radiance(const ShadedScene&, std::size_t, const std::array<float, 3>&, std::span<const float>, Rgb texture,
                 const ViewSample& view) const override {
        const auto cosine = float(view.to_viewer.z), side = float(view.to_viewer.x);
        return texture * Rgb{cosine * cosine, 0.5f + side, 1};
    }
};

// Small triangles, so that the region determines the error.
std::shared_ptr<ShadedScene> mosaic() {
    auto scene = std::make_shared<ShadedScene>();
    const double step = 0.5e-3;
    const auto corner = [&](int i, int j) { return Vec3{step * i, step * j, -4e-3}; };
    for (int j = -10; j < 10; ++j)
        for (int i = -12; i < 12; ++i) {
            add_triangle(*scene, corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), white);
            add_triangle(*scene, corner(i, j), corner(i + 1, j + 1), corner(i, j + 1), white);
        }
    scene->lighting = std::make_shared<Slanted>();
    return scene;
}

TEST(Interpolated, error_of_light_that_depends_on_the_viewer_grows_with_the_square_of_the_region) {
    const auto scene = mosaic();
    LightFieldGrid dense = grid;
    dense.hogels_s = dense.hogels_t = 9;
    dense.pitch = 0.1_mm;
    const LightFieldBuffer exact = render::render("simplex", std::shared_ptr<const ShadedScene>(scene), dense);
    const double coarse = difference(exact, interpolated(scene, 9, dense)).worst,
                 fine = difference(exact, interpolated(scene, 5, dense)).worst;
    EXPECT_LT(coarse, 0.05);
    EXPECT_GT(coarse, 1e-3) << "nothing is interpolated";
    // Viewpoints at half the distance, with the same triangles.
    EXPECT_LT(fine, 0.5 * coarse);
}

TEST(Interpolated, gives_the_same_bytes_for_any_tiling) {
    const auto scene = mosaic();
    const auto renderer = make_interpolating_renderer(scene, grid, 4);
    const LightFieldBuffer whole = interpolated(scene, 4);
    for (const HogelRange& range : {HogelRange{0, 0, 1, 1}, HogelRange{2, 1, 5, 4}, HogelRange{0, 0, 9, 7}}) {
        LightFieldTile tile(grid, range, true), expected(grid, range, true);
        renderer->read(tile);
        whole.read(expected);
        EXPECT_TRUE(std::ranges::equal(tile.radiance.elements(), expected.radiance.elements()));
        EXPECT_TRUE(std::ranges::equal(tile.depth.elements(), expected.depth.elements()));
    }
}

// Half-open slices cover a closed surface once, as the number of visits shows.
TEST(Interpolated, visits_each_sample_of_a_triangle_once) {
    const auto scene = mosaic();
    const auto renderer = make_interpolating_renderer(scene, grid, 9);
    LightFieldTile tile(grid, {0, 0, 9, 7}, true);
    renderer->read(tile);
    std::size_t covered = 0;
    for (const float depth : tile.depth.elements()) covered += std::isfinite(depth) ? 1 : 0;
    EXPECT_GT(covered, tile.depth.size() / 2);
    EXPECT_EQ(dynamic_cast<const CountsVisits&>(without_layers(*renderer)).visits().samples, covered);
}

TEST(Interpolated, refuses_what_it_cannot_render) {
    const auto scene = planes();
    const auto refused = [&](const LightFieldGrid& sampled, std::size_t region) {
        try {
            make_interpolating_renderer(scene, sampled, region);
        } catch (const Error& error) {
            return error.code() == ErrorCode::usage;
        }
        return false;
    };
    EXPECT_TRUE(refused(grid, 0));
    EXPECT_TRUE(refused(hemicube({2, 2, 1_mm, 8, 8, Perspective{1, 1}, 1})[1], 2));
    EXPECT_FALSE(refused(grid, 2));
}

}  // namespace
}  // namespace hogel::simplex
