// SPDX-License-Identifier: Apache-2.0
// Properties of every renderer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "hogel/error.h"
#include "hogel/render/test_renderers.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

const LightFieldGrid grid{5, 4, 1_mm, 33, 31, Perspective{0.5, 0.4}, 3};

class EveryRenderer : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, EveryRenderer, ::testing::ValuesIn(renderer_names()),
                         [](const auto& parameter) { return test_name(parameter.param); });

// Radiance that is linear over a plane is reproduced exactly by interpolation over any of its triangles, also where the
// plane crosses the hologram, so that ζ changes sign.
TEST_P(EveryRenderer, renders_a_tilted_plane_as_its_closed_form) {
    const auto radiance = [](Vec3 p) {
        return Rgb{float(0.5 + 40 * p.x), float(0.5 - 30 * p.y), float(0.5 + 50 * p.z)};
    };
    // z = 0.3 x − 0.2 y + offset, as a fan of triangles around a point off its centre.
    const double offset = crosses_plane(GetParam()) ? 0.4e-3 : -7e-3;
    const auto plane = [&](double x, double y) { return Vec3{x, y, 0.3 * x - 0.2 * y + offset}; };
    ShadedScene scene;
    const double e = 12e-3;
    const Vec3 hub = plane(1e-3, -0.7e-3);
    const std::array corners{plane(-e, -e), plane(e, -e), plane(e, e), plane(-e, e)};
    for (std::size_t i = 0; i < 4; ++i) add_triangle(scene, hub, corners[i], corners[(i + 1) % 4], radiance);
    scene.background = {9, 9, 9};
    const LightFieldBuffer seen = render(GetParam(), scene, grid);
    std::size_t front = 0, behind = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t v = 0; v < grid.directions_v; ++v)
                for (std::size_t u = 0; u < grid.directions_u; ++u) {
                    // −ζ = 0.3 (s + Uζ) − 0.2 (t + Vζ) + offset
                    const double S = grid.s(double(s)), T = grid.t(double(t)), U = grid.u(double(u)),
                                 V = grid.v(double(v));
                    const double depth = -(0.3 * S - 0.2 * T + offset) / (1 + 0.3 * U - 0.2 * V);
                    const Rgb expected = radiance({S + U * depth, T + V * depth, -depth});
                    ASSERT_NEAR(seen.depth(t, s, v, u), depth, 1e-9) << s << " " << t << " " << u << " " << v;
                    ASSERT_NEAR(seen.radiance(0, t, s, v, u), expected.r, 1e-5);
                    ASSERT_NEAR(seen.radiance(1, t, s, v, u), expected.g, 1e-5);
                    ASSERT_NEAR(seen.radiance(2, t, s, v, u), expected.b, 1e-5);
                    (depth > 0 ? behind : front) += 1;
                }
    if (crosses_plane(GetParam())) {
        EXPECT_GT(front, 100u);
    }
    EXPECT_GT(behind, 100u);
}

// A wall of triangles that share edges and corners; many of these are exactly on rays.
TEST_P(EveryRenderer, leaves_no_gap_between_triangles_that_share_edges) {
    ShadedScene scene;
    scene.background = {0, 0, 0};
    const double depth = 4e-3;
    // With these steps many corners are on rays: x = s + Uζ with U a multiple of ΔU/2.
    const double step_x = 0.5 * grid.step_u() * depth * 3, step_y = 0.5 * grid.step_v() * depth * 3;
    const auto corner = [&](int i, int j) { return Vec3{i * step_x, j * step_y, -depth}; };
    for (int j = -40; j < 40; ++j)
        for (int i = -40; i < 40; ++i) {
            if ((i + j) % 2 == 0) {
                add_triangle(scene, corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), white);
                add_triangle(scene, corner(i, j), corner(i + 1, j + 1), corner(i, j + 1), white);
            } else {
                add_triangle(scene, corner(i, j), corner(i + 1, j), corner(i, j + 1), white);
                add_triangle(scene, corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1), white);
            }
        }
    LightFieldGrid centred = grid;
    centred.pitch = step_x;
    const LightFieldBuffer seen = render(GetParam(), scene, centred);
    for (float value : seen.radiance.elements()) ASSERT_NEAR(value, 1, 1e-6);
}

// A wall like the one above, one triangle at a time. (A ray caster may hit both neighbours at a shared edge.)
TEST(Renderers, that_scan_convert_give_each_sample_to_one_of_two_adjacent_triangles) {
    const double depth = 4e-3, step_x = 0.5 * grid.step_u() * depth * 9, step_y = 0.5 * grid.step_v() * depth * 9;
    LightFieldGrid centred = grid;
    centred.pitch = step_x;
    const auto corner = [&](int i, int j) { return Vec3{i * step_x, j * step_y, -depth + 1e-4 * ((i * i + j) % 3)}; };
    for (const std::string name : {"zbuffer", "epi"}) {
        ShadedScene whole;
        Array<int, 1> owners({centred.hogels() * centred.directions()});
        for (int j = -7; j < 7; ++j)
            for (int i = -7; i < 7; ++i)
                for (const int half : {0, 1}) {
                    const Vec3 a = corner(i, j), b = half == 0 ? corner(i + 1, j) : corner(i + 1, j + 1);
                    const Vec3 c = half == 0 ? corner(i + 1, j + 1) : corner(i, j + 1);
                    ShadedScene scene;
                    add_triangle(scene, a, b, c, white);
                    add_triangle(whole, a, b, c, white);
                    const LightFieldBuffer seen = render(name, scene, centred);
                    for (std::size_t k = 0; k < owners.size(); ++k)
                        owners(k) += std::isfinite(seen.depth.data()[k]) ? 1 : 0;
                }
        const LightFieldBuffer seen = render(name, whole, centred);
        std::size_t hits = 0;
        for (std::size_t k = 0; k < owners.size(); ++k) {
            ASSERT_EQ(owners(k), std::isfinite(seen.depth.data()[k]) ? 1 : 0) << name;
            hits += std::size_t(owners(k));
        }
        EXPECT_GT(hits, owners.size() / 2) << name;
    }
}

TEST_P(EveryRenderer, prefers_a_tile_that_lies_in_the_grid) {
    for (std::size_t hogels : {1, 7, 300})
        for (std::size_t directions : {1, 50, 1000}) {
            const LightFieldGrid g{hogels, 5, 1_mm, directions, 40, Perspective{0.5, 0.4}, 3};
            const HogelRange tile = make_renderer(GetParam(), std::make_shared<ShadedScene>(), g)->preferred_tile();
            EXPECT_TRUE(tile.ns >= 1 && tile.ns <= g.hogels_s && tile.nt >= 1 && tile.nt <= g.hogels_t);
        }
}

TEST_P(EveryRenderer, gives_the_same_bytes_for_any_tiling) {
    std::mt19937 random(11);
    const ShadedScene scene = random_scene(random, 40, !crosses_plane(GetParam()));
    const LightFieldBuffer whole = render(GetParam(), scene, grid);
    const auto renderer = make_renderer(GetParam(), std::make_shared<const ShadedScene>(scene), grid);
    for (const HogelRange& range : {HogelRange{0, 0, 1, 1}, HogelRange{2, 1, 3, 2}, HogelRange{4, 3, 1, 1},
                                    HogelRange{0, 2, 5, 1}, HogelRange{3, 0, 1, 4}, HogelRange{0, 0, 5, 4}}) {
        LightFieldTile tile(grid, range, true), expected(grid, range, true);
        // The previous content of the tile must not matter.
        std::ranges::fill(tile.radiance.elements(), -7.0f);
        std::ranges::fill(tile.depth.elements(), -7.0f);
        renderer->read(tile);
        whole.read(expected);
        EXPECT_TRUE(std::ranges::equal(tile.radiance.elements(), expected.radiance.elements()));
        EXPECT_TRUE(std::ranges::equal(tile.depth.elements(), expected.depth.elements()));
    }
}

TEST_P(EveryRenderer, renders_an_empty_scene_as_background_at_infinite_depth) {
    ShadedScene scene;
    scene.background = {0.1f, 0.2f, 0.3f};
    const LightFieldBuffer seen = render(GetParam(), scene, grid);
    for (float depth : seen.depth.elements()) ASSERT_EQ(depth, std::numeric_limits<float>::infinity());
    for (std::size_t c = 0; c < 3; ++c)
        for (float value : seen.radiance[c].elements()) ASSERT_EQ(value, 0.1f * float(c + 1) + 0.0f) << c;
}

// A convex body of 32 faces around a point: an octahedron in a random orientation with its edges halved and all corners
// moved onto a sphere. The corners of faces run counterclockwise seen from outside.
std::vector<std::array<Vec3, 3>> random_body(std::mt19937& random, Vec3 middle) {
    std::normal_distribution<double> normal;
    const auto direction = [&] { return normalize(Vec3{normal(random), normal(random), normal(random)}); };
    const Vec3 a = direction(), b = normalize(cross(a, direction())), c = cross(a, b);
    std::vector<std::array<Vec3, 3>> faces;
    for (int octant = 0; octant < 8; ++octant) {
        const Vec3 x = octant & 1 ? -a : a, y = octant & 2 ? -b : b, z = octant & 4 ? -c : c;
        const Vec3 xy = normalize(x + y), yz = normalize(y + z), zx = normalize(z + x);
        for (auto face :
             {std::array{x, xy, zx}, std::array{xy, y, yz}, std::array{zx, yz, z}, std::array{xy, yz, zx}}) {
            if (dot(cross(face[1] - face[0], face[2] - face[0]), face[0]) < 0) std::swap(face[1], face[2]);
            for (Vec3& corner : face) corner = middle + 2e-3 * corner;
            faces.push_back(face);
        }
    }
    return faces;
}

// A ray meets a convex body exactly if some of its points are on the inner side of all faces. Culling back faces
// changes nothing; if the body is turned inside out, its far side is visible.
TEST_P(EveryRenderer, covers_a_closed_body_without_gaps) {
    std::mt19937 random(3);
    std::size_t inside = 0, outside = 0;
    for (int round = 0; round < (cuts_simplices(GetParam()) ? 1 : 6); ++round) {
        const Vec3 middle{0.2e-3, -0.3e-3, crosses_plane(GetParam()) && round % 2 == 0 ? 0.4e-3 : -4e-3};
        const std::vector<std::array<Vec3, 3>> faces = random_body(random, middle);
        ShadedScene scene;
        for (const auto& [p, q, r] : faces) add_triangle(scene, p, q, r, white);
        const LightFieldBuffer seen = render(GetParam(), scene, grid);
        scene.fronts_only = true;
        const LightFieldBuffer fronts = render(GetParam(), scene, grid);
        for (ShadedScene::Triangle& triangle : scene.triangles) std::swap(triangle.vertices[1], triangle.vertices[2]);
        const LightFieldBuffer backs = render(GetParam(), scene, grid);
        for (std::size_t t = 0; t < grid.hogels_t; ++t)
            for (std::size_t s = 0; s < grid.hogels_s; ++s)
                for (std::size_t v = 0; v < grid.directions_v; ++v)
                    for (std::size_t u = 0; u < grid.directions_u; ++u) {
                        // (s + Uζ, t + Vζ, −ζ) on the inner side of a face bounds ζ from one side.
                        const Vec3 from{grid.s(double(s)), grid.t(double(t)), 0},
                            direction{grid.u(double(u)), grid.v(double(v)), -1};
                        double enters = -1, leaves = 1;
                        for (const auto& [p, q, r] : faces) {
                            const Vec3 out = cross(q - p, r - p);
                            const double slope = dot(out, direction), at = dot(out, p - from) / slope;
                            if (slope < 0) enters = std::max(enters, at);
                            if (slope > 0) leaves = std::min(leaves, at);
                        }
                        if (std::abs(leaves - enters) < 1e-9) continue;
                        const bool hit = enters < leaves;
                        ++(hit ? inside : outside);
                        for (const LightFieldBuffer* field : {&seen, &fronts, &backs})
                            ASSERT_NEAR(field->radiance(0, t, s, v, u), hit ? 1 : 0, 1e-6);
                        if (!hit) continue;
                        ASSERT_NEAR(seen.depth(t, s, v, u), enters, 1e-7);
                        ASSERT_NEAR(fronts.depth(t, s, v, u), enters, 1e-7);
                        ASSERT_NEAR(backs.depth(t, s, v, u), leaves, 1e-7);
                    }
    }
    EXPECT_GT(inside, 2000u);
    EXPECT_GT(outside, 2000u);
}

TEST(Renderers, that_do_not_cross_the_plane_refuse_scenes_that_do) {
    ShadedScene scene;
    add_triangle(scene, {0, 0, -1e-3}, {1e-3, 0, -1e-3}, {0, 1e-3, 2e-3}, white);
    std::size_t refused = 0;
    for (const RendererInfo& info : renderers().rows()) {
        try {
            make_renderer(info.name, std::make_shared<const ShadedScene>(scene), grid);
            EXPECT_TRUE(info.crosses_plane) << info.name;
        } catch (const Error& error) {
            ++refused;
            EXPECT_FALSE(info.crosses_plane) << info.name;
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_NE(std::string(error.what()).find("'" + std::string(info.name) + "' needs"), std::string::npos);
            EXPECT_NE(std::string(error.what()).find("z = 0.002 m; 'raytrace'"), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(refused, 0u);
    EXPECT_TRUE(crosses_plane("raytrace"));
}

// A tiny triangle in front of a hogel, at twice and half the depth of the near plane (10⁻⁶ of the scene's size).
TEST(Renderers, that_do_not_cross_the_plane_see_up_to_their_near_plane) {
    const double size = 8e-3, near = 1e-6 * size;
    for (double depth : {2 * near, 0.5 * near}) {
        const Vec3 p{grid.s(1), grid.t(2), -depth};
        ShadedScene scene;
        add_triangle(scene, {-1e-3, 0, -size}, {1e-3, 0, -size}, {0, 1e-6, -size}, white);
        add_triangle(scene, p + Vec3{-100e-9, -80e-9, 0}, p + Vec3{100e-9, -80e-9, 0}, p + Vec3{0, 90e-9, 0}, [](Vec3) {
            return Rgb{1, 1, 1};
        });
        for (const RendererInfo& info : renderers().rows()) {
            if (info.crosses_plane) continue;
            const LightFieldBuffer seen = render(std::string(info.name), scene, grid);
            for (float value : seen.depth[2][1].elements()) {
                if (depth > near) {
                    ASSERT_NEAR(value, depth, 1e-12) << info.name;
                } else {
                    ASSERT_NE(value, static_cast<float>(depth)) << info.name;
                }
            }
        }
    }
}

}  // namespace
}  // namespace hogel::render
