// SPDX-License-Identifier: Apache-2.0
// Compares sides of a hemicube and off-centre directions with the front of the rotated scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "hogel/render/test_renderers.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

const LightFieldGrid front{5, 4, 1_mm, 22, 18, Perspective{1, 1}, 3};

// Flat triangles of random colours, some far to the sides, from 0.2 to 8 mm behind the hologram or on both sides of it.
ShadedScene scattered_scene(std::mt19937& random, bool behind) {
    std::uniform_real_distribution<double> aside(-16e-3, 16e-3), depth(behind ? 0.2e-3 : -4e-3, 8e-3),
        step(-9e-3, 9e-3);
    std::uniform_real_distribution<float> colour(0, 1);
    ShadedScene scene;
    scene.background = {0.5f, 0.5f, 0.5f};
    for (std::uint32_t i = 0; i < 24; ++i) {
        const Vec3 middle{aside(random), aside(random), -depth(random)};
        const Rgb flat{colour(random), colour(random), colour(random)};
        for (int corner = 0; corner < 3; ++corner) {
            Vec3 p = middle + Vec3{step(random), step(random), step(random)};
            if (behind) p.z = std::min(p.z, -0.1e-3);
            scene.positions.push_back(p);
            scene.radiance.push_back(flat);
        }
        scene.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, ShadedScene::no_texture, 0});
    }
    scene.texture_coordinates.resize(scene.positions.size());
    return scene;
}

class Faces : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, Faces, ::testing::ValuesIn(renderer_names()),
                         [](const auto& parameter) { return test_name(parameter.param); });

// A face of a hogel equals the front for the scene rotated around the hogel, except along edges (rounding).
void compare_with_rotated_scene(const std::string& name, const ShadedScene& scene, const LightFieldGrid& grid) {
    const LightFieldBuffer seen = render(name, scene, grid);
    std::size_t hits = 0, different = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s) {
            ShadedScene rotated = scene;
            for (Vec3& p : rotated.positions) {
                const Vec3 q = to_face(grid.face(), {p.x - grid.s(double(s)), p.y - grid.t(double(t)), -p.z});
                p = {q.x, q.y, -q.z};
            }
            LightFieldGrid one = grid;
            one.hogels_s = one.hogels_t = 1;
            one.view = Perspective{one.range()};
            const LightFieldBuffer expected = render("raytrace", rotated, one);
            for (std::size_t v = 0; v < grid.directions_v; ++v)
                for (std::size_t u = 0; u < grid.directions_u; ++u) {
                    const double deepening = grid.direction_of(grid.u(double(u)), grid.v(double(v))).z;
                    const double depth = expected.depth(0, 0, v, u) * deepening, found = seen.depth(t, s, v, u);
                    hits += std::isfinite(depth) ? 1 : 0;
                    bool same = found == depth || std::abs(found - depth) < 1e-7;
                    for (std::size_t c = 0; c < 3; ++c)
                        same = same && std::abs(seen.radiance(c, t, s, v, u) - expected.radiance(c, 0, 0, v, u)) < 1e-5;
                    different += same ? 0 : 1;
                }
        }
    EXPECT_GT(hits, grid.hogels() * grid.directions() / 20) << hogel::face_name(grid.face());
    EXPECT_LE(different, grid.hogels() * grid.directions() / 2000) << hogel::face_name(grid.face());
}

TEST_P(Faces, are_front_views_of_the_rotated_scene) {
    std::mt19937 random(3);
    for (int round = 0; round < 4; ++round) {
        const bool behind = round % 2 == 0;
        ShadedScene scene = scattered_scene(random, behind);
        scene.fronts_only = round >= 2;
        if (!behind && !crosses_plane(GetParam())) continue;
        const double view = round == 0 ? 2.3 : std::numbers::pi;
        for (const LightFieldGrid& face : hemicube(front, view, view))
            compare_with_rotated_scene(GetParam(), scene, face);
    }
}

TEST_P(Faces, off_centre_directions_see_what_centred_ones_see) {
    std::mt19937 random(4);
    const ShadedScene scene = scattered_scene(random, true);
    LightFieldGrid aside = front;
    aside.range().center_u = 0.7;
    aside.range().center_v = -0.4;
    compare_with_rotated_scene(GetParam(), scene, aside);
    // The last six columns as a separate view.
    LightFieldGrid part = front;
    part.directions_u = 6;
    part.range().half_u = front.half_u() * 6 / 22;
    part.range().center_u = front.u(18.5);
    const LightFieldBuffer whole = render(GetParam(), scene, front), right = render(GetParam(), scene, part);
    for (std::size_t t = 0; t < front.hogels_t; ++t)
        for (std::size_t s = 0; s < front.hogels_s; ++s)
            for (std::size_t v = 0; v < front.directions_v; ++v)
                for (std::size_t u = 0; u < 6; ++u)
                    ASSERT_NEAR(whole.radiance(0, t, s, v, 16 + u), right.radiance(0, t, s, v, u), 1e-5);
}

TEST_P(Faces, give_the_same_bytes_for_any_tiling) {
    std::mt19937 random(5);
    const ShadedScene scene = scattered_scene(random, !crosses_plane(GetParam()));
    for (const LightFieldGrid& face : hemicube(front)) {
        const LightFieldBuffer whole = render(GetParam(), scene, face);
        const auto renderer = make_renderer(GetParam(), std::make_shared<const ShadedScene>(scene), face);
        for (const HogelRange& range : {HogelRange{0, 0, 1, 1}, HogelRange{2, 1, 3, 2}, HogelRange{4, 3, 1, 1},
                                        HogelRange{0, 2, 5, 1}, HogelRange{3, 0, 1, 4}}) {
            LightFieldTile tile(face, range, true), expected(face, range, true);
            renderer->read(tile);
            whole.read(expected);
            EXPECT_TRUE(std::ranges::equal(tile.radiance.elements(), expected.radiance.elements()));
            EXPECT_TRUE(std::ranges::equal(tile.depth.elements(), expected.depth.elements()));
        }
    }
}

}  // namespace
}  // namespace hogel::render
