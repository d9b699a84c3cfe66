// SPDX-License-Identifier: Apache-2.0
// Compares renderers: all give the samples of ray casting, except at silhouettes, where rounding decides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "hogel/render/oblique_triangle.h"
#include "hogel/render/test_renderers.h"
#include "hogel/units.h"
#include "thesis/simplex/volume.h"

namespace hogel::render {
namespace {

using namespace literals;

const LightFieldGrid grid{5, 4, 1_mm, 33, 31, Perspective{0.5, 0.4}, 3};

class Agreement : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, Agreement, ::testing::ValuesIn(renderer_names()),
                         [](const auto& parameter) { return test_name(parameter.param); });

// Whether a neighbouring direction has a different depth, as at a silhouette.
bool near_silhouette(const LightFieldBuffer& light_field, std::size_t t, std::size_t s, std::size_t v, std::size_t u,
                     double jump) {
    const float here = light_field.depth(t, s, v, u);
    const LightFieldGrid& sampled = light_field.grid();
    for (std::size_t l = v > 0 ? v - 1 : 0; l < std::min(v + 2, sampled.directions_v); ++l)
        for (std::size_t k = u > 0 ? u - 1 : 0; k < std::min(u + 2, sampled.directions_u); ++k) {
            const float there = light_field.depth(t, s, l, k);
            if (std::isinf(here) != std::isinf(there) || std::abs(here - there) > jump) return true;
        }
    return false;
}

// Number of samples compared away from silhouettes, and number of them that show a triangle.
struct Compared {
    std::size_t samples = 0, hits = 0;
};

// Compares all samples away from silhouettes, except within `margin` of the border of a hogel's view.
void expect_agreement(const LightFieldBuffer& first, const LightFieldBuffer& second, std::size_t margin,
                      Compared& compared) {
    const LightFieldGrid& sampled = first.grid();
    for (std::size_t t = 0; t < sampled.hogels_t; ++t)
        for (std::size_t s = 0; s < sampled.hogels_s; ++s)
            for (std::size_t v = margin; v + margin < sampled.directions_v; ++v)
                for (std::size_t u = margin; u + margin < sampled.directions_u; ++u) {
                    if (near_silhouette(first, t, s, v, u, 0.4e-3)) continue;
                    ++compared.samples;
                    const bool hit = std::isfinite(first.depth(t, s, v, u));
                    compared.hits += hit ? 1 : 0;
                    ASSERT_EQ(hit, std::isfinite(second.depth(t, s, v, u)));
                    if (hit) {
                        ASSERT_NEAR(first.depth(t, s, v, u), second.depth(t, s, v, u), 1e-7);
                    }
                    for (std::size_t c = 0; c < 3; ++c)
                        ASSERT_NEAR(first.radiance(c, t, s, v, u), second.radiance(c, t, s, v, u), 1e-3);
                }
}

// The reference intersects rays with a hierarchy; the others project and scan convert.
TEST_P(Agreement, with_ray_casting_on_random_scenes) {
    std::mt19937 random(1);
    Compared compared;
    // Simplices are slow.
    const int rounds = cuts_simplices(GetParam()) ? 8 : 40;
    for (int round = 0; round < rounds; ++round) {
        const bool behind = round % 2 == 0 || !crosses_plane(GetParam());
        ShadedScene scene = random_scene(random, 16, behind);
        scene.fronts_only = round % 4 >= 2;
        expect_agreement(render("raytrace", scene, grid), render(GetParam(), scene, grid), 0, compared);
        ASSERT_FALSE(HasFatalFailure()) << round;
    }
    EXPECT_GT(compared.samples, static_cast<std::size_t>(rounds) * 7000);
    EXPECT_GT(compared.hits, static_cast<std::size_t>(rounds) * 3000);
}

// Many more scenes, of one and of several triangles, in the smallest possible views.
TEST_P(Agreement, with_ray_casting_on_2000_random_scenes) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> aside(-0.4, 0.4);
    Compared compared;
    for (int round = 0; round < 2000; ++round) {
        const bool behind = round % 2 == 0;
        ShadedScene scene = random_scene(random, 8, behind);
        if (!behind && !crosses_plane(GetParam())) continue;
        scene.fronts_only = round % 8 >= 4;
        // Each kind of triangle alone, then all together.
        if (round % 32 < 16) scene.triangles = {scene.triangles[static_cast<std::size_t>(round / 2 % 8)]};
        LightFieldGrid window{2, 2, 1.7_mm, 5, 4, Perspective{0.0758, 0.0516}, 3};
        window.range().center_u = aside(random);
        window.range().center_v = aside(random);
        expect_agreement(render("raytrace", scene, window), render(GetParam(), scene, window), 1, compared);
        ASSERT_FALSE(HasFatalFailure()) << round;
    }
    EXPECT_GT(compared.samples, 7000u);
    EXPECT_GT(compared.hits, 1500u);
}

// On the frequencies of a hologram, by the renderers that take them: for a view within which all directions are rays,
// and for one whose corners are evanescent.
TEST_P(Agreement, with_ray_casting_on_frequencies) {
    if (!renderers().find(GetParam()).takes_frequencies) return;
    std::mt19937 random(3);
    Compared compared;
    for (int round = 0; round < 40; ++round) {
        ShadedScene scene = random_scene(random, 16, round % 2 == 0);
        scene.fronts_only = round % 4 >= 2;
        const LightFieldGrid sines = round % 8 < 4
                                         ? LightFieldGrid{5, 4, 1_mm, 33, 31, Frequencies{{0.44, 0.37, 0.1, -0.05}}, 3}
                                         : LightFieldGrid{5, 4, 1_mm, 33, 31, Frequencies{{0.96, 0.96}}, 3};
        expect_agreement(render("raytrace", scene, sines), render(GetParam(), scene, sines), 0, compared);
        ASSERT_FALSE(HasFatalFailure()) << round;
    }
    EXPECT_GT(compared.samples, 40u * 7000);
    EXPECT_GT(compared.hits, 40u * 2000);
}

// The renderers that use ObliqueTriangle to decide which samples see a triangle give exactly the result of testing
// every ray against every triangle, independently of order and region. The grid has samples at its centre, where rays
// pass through vertices and along edges.
class SampleFindingRenderer : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, SampleFindingRenderer,
                         ::testing::Values("simplex", "simplex-strips", "simploid", "simplex3d", "oblique", "mvr"),
                         [](const auto& parameter) { return test_name(parameter.param); });

TEST_P(SampleFindingRenderer, finds_what_a_test_of_every_ray_against_every_triangle_finds) {
    const LightFieldGrid odd{3, 5, 1_mm, 21, 19, Perspective{0.5, 0.4}, 3};
    std::mt19937 random(5);
    std::uniform_int_distribution<int> step(-4, 4), deeper(1, 6);
    const int rounds = cuts_simplices(GetParam()) ? 10 : 40;
    for (int round = 0; round < rounds; ++round) {
        const bool behind = !crosses_plane(GetParam()) || round % 4 < 2;
        ShadedScene scene = random_scene(random, 16, behind);
        // Half of the scenes have all vertices on a lattice of half a hogel and a millimetre of depth.
        if (round % 2 == 0)
            for (Vec3& p : scene.positions)
                p = {0.5e-3 * step(random), 0.5e-3 * step(random), 1e-3 * (behind ? -deeper(random) : step(random))};
        scene.fronts_only = round % 8 >= 4;
        const double min_depth = crosses_plane(GetParam()) ? -1 : simplex::near_plane(scene, GetParam());
        LightFieldBuffer expected(odd, true);
        LightFieldTile tile(odd, {0, 0, odd.hogels_s, odd.hogels_t}, true);
        for (std::size_t t = 0; t < odd.hogels_t; ++t)
            for (std::size_t s = 0; s < odd.hogels_s; ++s)
                for (std::size_t v = 0; v < odd.directions_v; ++v)
                    for (std::size_t u = 0; u < odd.directions_u; ++u) {
                        NearestTriangle seen;
                        for (std::uint32_t i : triangles_with_area(scene))
                            see(seen, i, ObliqueTriangle(scene, i, odd.u(double(u)), odd.v(double(v))),
                                odd.s(double(s)), odd.t(double(t)), min_depth);
                        store(tile, scene, odd, seen, t, s, v, u);
                    }
        expected.write(tile);
        const LightFieldBuffer found = render(GetParam(), scene, odd);
        ASSERT_TRUE(std::ranges::equal(found.radiance.elements(), expected.radiance.elements())) << round;
        ASSERT_TRUE(std::ranges::equal(found.depth.elements(), expected.depth.elements())) << round;
    }
}

// Triangles much smaller than the distance between hogels, in front of the hologram plane, on it and behind it.
TEST(Renderers, agree_on_a_fine_mesh_around_the_hologram_plane) {
    ShadedScene scene;
    scene.background = {0.5f, 0.5f, 0.5f};
    const std::size_t around = 72, down = 36;
    for (std::size_t j = 0; j <= down; ++j)
        for (std::size_t i = 0; i < around; ++i) {
            const double theta = 3.14159265358979 * double(j) / double(down);
            const double phi = 6.28318530717959 * double(i) / double(around);
            const Vec3 n{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
            const double radius = 2e-3 * (1 + 0.1 * std::sin(5 * phi) * std::sin(4 * theta) * std::sin(theta));
            add_vertex(scene, radius * n + Vec3{0.3e-3, -0.2e-3, -0.7e-3},
                       {float(0.5 + 0.5 * n.x), float(0.5 + 0.5 * n.y), float(0.5 + 0.5 * n.z)});
        }
    const auto at = [&](std::size_t j, std::size_t i) { return static_cast<std::uint32_t>(j * around + i % around); };
    for (std::size_t j = 0; j < down; ++j)
        for (std::size_t i = 0; i < around; ++i) {
            scene.triangles.push_back({{at(j, i), at(j + 1, i), at(j + 1, i + 1)}, ShadedScene::no_texture, 0});
            scene.triangles.push_back({{at(j, i), at(j + 1, i + 1), at(j, i + 1)}, ShadedScene::no_texture, 0});
        }
    const std::vector<std::string> names = renderer_names();
    const LightFieldBuffer first = render(names[0], scene, grid);
    for (std::size_t other = 1; other < names.size(); ++other) {
        if (!crosses_plane(names[other])) continue;
        const LightFieldBuffer second = render(names[other], scene, grid);
        std::size_t hits = 0, different = 0;
        for (std::size_t i = 0; i < first.depth.size(); ++i) {
            const float a = first.depth.data()[i], b = second.depth.data()[i];
            hits += std::isfinite(a) ? 1 : 0;
            if (std::isfinite(a) != std::isfinite(b) || (std::isfinite(a) && std::abs(a - b) > 1e-7f)) ++different;
        }
        EXPECT_GT(hits, 5000u);
        // Rounding decides about rays along silhouettes.
        EXPECT_LE(different, 1u) << names[other];
    }
}

// A sloping textured quadrilateral beside a plain triangle, in one channel and in three.
TEST(Renderers, agree_on_textures_without_depth) {
    ShadedScene scene;
    scene.background = {0.1f, 0.2f, 0.3f};
    auto picture = std::make_shared<Image>();
    picture->pixels = Array<float, 3>({4, 5, 3});
    for (std::size_t i = 0; i < picture->pixels.size(); ++i)
        picture->pixels.data()[i] = 0.5f + 0.5f * std::sin(float(3 * i));
    scene.textures.emplace_back(picture);
    const auto vertex = [&](Vec3 p, Rgb radiance, float u, float v) {
        scene.positions.push_back(p);
        scene.radiance.push_back(radiance);
        scene.texture_coordinates.push_back({u, v});
    };
    vertex({-2.05e-3, -2.1e-3, 1e-3}, {1, 0.5f, 0.2f}, 0, 0);
    vertex({2.02e-3, -1.9e-3, -3e-3}, {0.5f, 0.5f, 0.9f}, 1, 0);
    vertex({2.1e-3, 2e-3, -3e-3}, {1, 1, 1}, 1, 1);
    vertex({-1.95e-3, 2.03e-3, 1e-3}, {0.2f, 0.9f, 0.2f}, 0, 1);
    scene.triangles = {{{0, 1, 2}, 0, 0}, {{0, 2, 3}, 0, 0}};
    add_triangle(scene, {-4.1e-3, -4.3e-3, -2e-3}, {0.11e-3, -4.2e-3, -2e-3}, {0.17e-3, 3e-3, -6e-3}, [](Vec3 p) {
        return Rgb{float(0.5 + 40 * p.x), float(0.5 - 30 * p.y), float(0.5 + 50 * p.z)};
    });
    const std::vector<std::string> names = renderer_names();
    for (const std::size_t channels : {1, 3}) {
        LightFieldGrid sampled = grid;
        sampled.channels = channels;
        const LightFieldBuffer first = render(names[0], scene, sampled);
        for (std::size_t other = 1; other < names.size(); ++other) {
            if (!crosses_plane(names[other])) continue;
            const auto source = make_renderer(names[other], std::make_shared<const ShadedScene>(scene), sampled);
            LightFieldTile tile(sampled, {0, 0, grid.hogels_s, grid.hogels_t}, false);
            source->read(tile);
            std::size_t different = 0;
            for (std::size_t i = 0; i < tile.radiance.size(); ++i)
                if (std::abs(tile.radiance.data()[i] - first.radiance.data()[i]) > 1e-4f) ++different;
            // Rounding decides about rays along edges.
            EXPECT_LE(different, 2 * channels) << names[other];
        }
    }
}

}  // namespace
}  // namespace hogel::render
