// SPDX-License-Identifier: Apache-2.0
#include "hogel/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "hogel/error.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/simplex/volume.h"
#include "hogel/render/test_names.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

std::uint32_t add_vertex(ShadedScene& scene, Vec3 position, Rgb radiance) {
    scene.positions.push_back(position);
    scene.radiance.push_back(radiance);
    scene.texture_coordinates.push_back({});
    return static_cast<std::uint32_t>(scene.positions.size() - 1);
}

void add_triangle(ShadedScene& scene, Vec3 a, Vec3 b, Vec3 c, const std::function<Rgb(Vec3)>& radiance) {
    const std::uint32_t first = add_vertex(scene, a, radiance(a));
    add_vertex(scene, b, radiance(b));
    add_vertex(scene, c, radiance(c));
    scene.triangles.push_back({{first, first + 1, first + 2}, ShadedScene::no_texture, 0});
}

LightFieldBuffer render(const std::string& name, const ShadedScene& scene, const LightFieldGrid& grid) {
    LightFieldBuffer light_field(grid, true);
    copy(*make_renderer(name, std::make_shared<const ShadedScene>(scene), grid), light_field);
    return light_field;
}

const LightFieldGrid grid{5, 4, 1_mm, 33, 31, Perspective{0.5, 0.4}, 3};

std::vector<std::string> names() {
    std::vector<std::string> list;
    for (const RendererInfo& info : renderers().rows()) list.emplace_back(info.name);
    return list;
}

bool crosses_plane(std::string_view name) { return renderers().find(name).crosses_plane; }

// Random triangles within 4 mm of the hologram plane, or from 1 to 9 mm behind it. Some have no area, some are as thin
// as a line, and of some both faces show, one from some hogels and the other from the rest; behind the plane some come
// as near to it as any renderer can look.
ShadedScene random_scene(std::mt19937& random, std::size_t count, bool behind) {
    std::uniform_real_distribution<double> place(-4e-3, 4e-3);
    std::uniform_real_distribution<float> colour(0, 1);
    ShadedScene scene;
    scene.background = {0.5f, 0.5f, 0.5f};
    const auto point = [&] { return Vec3{place(random), place(random), place(random) - (behind ? 5e-3 : 0)}; };
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 a = point(), b = point(), c = point();
        if (i % 8 == 0) c = a;
        if (i % 8 == 1) c = 0.5 * (a + b) + 1e-9 * c;
        if (i % 8 == 2 || i % 8 == 3) {
            // A plane through a point among the hogels.
            const Vec3 seen_edge_on{0.4 * place(random), 0.4 * place(random), 0};
            b = a + 0.1 * b;
            c = seen_edge_on + 0.6 * (a - seen_edge_on) + 0.3 * (b - seen_edge_on);
        }
        if (i % 8 == 4 && behind) c.z = -1e-9;
        const Rgb flat{colour(random), colour(random), colour(random)};
        add_triangle(scene, a, b, c, [&](Vec3) { return flat; });
    }
    return scene;
}

class EveryRenderer : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, EveryRenderer, ::testing::ValuesIn(names()),
                         [](const auto& parameter) { return test_name(parameter.param); });

// A radiance that is linear over a plane is reproduced exactly by interpolation over any of its triangles, also where
// the plane passes through the hologram: there ζ changes sign and the view of a hogel turns inside out.
TEST_P(EveryRenderer, sees_a_tilted_plane_where_geometry_says) {
    const auto radiance = [](Vec3 p) {
        return Rgb{float(0.5 + 40 * p.x), float(0.5 - 30 * p.y), float(0.5 + 50 * p.z)};
    };
    // z = 0.3 x − 0.2 y + offset, as a fan of triangles around a point off centre.
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

// A wall of triangles that share edges and corners, many of which rays meet exactly: no ray slips through.
TEST_P(EveryRenderer, leaves_no_crack_between_triangles_that_share_edges) {
    ShadedScene scene;
    scene.background = {0, 0, 0};
    const double depth = 4e-3;
    // With these steps many corners lie on rays: x = s + Uζ for U a multiple of ΔU/2.
    const double step_x = 0.5 * grid.step_u() * depth * 3, step_y = 0.5 * grid.step_v() * depth * 3;
    const auto corner = [&](int i, int j) { return Vec3{i * step_x, j * step_y, -depth}; };
    for (int j = -40; j < 40; ++j)
        for (int i = -40; i < 40; ++i) {
            const auto white = [](Vec3) { return Rgb{1, 1, 1}; };
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

// A wall like the one above, one triangle at a time: no sample belongs to two of them. (A ray caster may well hit both
// neighbours where it meets their edge.)
TEST(Renderers, that_scan_convert_give_no_sample_to_two_triangles_that_share_an_edge) {
    const double depth = 4e-3, step_x = 0.5 * grid.step_u() * depth * 9, step_y = 0.5 * grid.step_v() * depth * 9;
    LightFieldGrid centred = grid;
    centred.pitch = step_x;
    const auto corner = [&](int i, int j) { return Vec3{i * step_x, j * step_y, -depth + 1e-4 * ((i * i + j) % 3)}; };
    const auto white = [](Vec3) { return Rgb{1, 1, 1}; };
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

TEST_P(EveryRenderer, prefers_tiles_that_exist) {
    for (std::size_t hogels : {1, 7, 300})
        for (std::size_t directions : {1, 50, 1000}) {
            const LightFieldGrid g{hogels, 5, 1_mm, directions, 40, Perspective{0.5, 0.4}, 3};
            const HogelRange tile = make_renderer(GetParam(), std::make_shared<ShadedScene>(), g)->preferred_tile();
            EXPECT_TRUE(tile.ns >= 1 && tile.ns <= g.hogels_s && tile.nt >= 1 && tile.nt <= g.hogels_t);
        }
}

TEST_P(EveryRenderer, gives_the_same_bytes_in_any_tiling) {
    std::mt19937 random(11);
    const ShadedScene scene = random_scene(random, 40, !crosses_plane(GetParam()));
    const LightFieldBuffer whole = render(GetParam(), scene, grid);
    const auto renderer = make_renderer(GetParam(), std::make_shared<const ShadedScene>(scene), grid);
    for (const HogelRange& range : {HogelRange{0, 0, 1, 1}, HogelRange{2, 1, 3, 2}, HogelRange{4, 3, 1, 1},
                                    HogelRange{0, 2, 5, 1}, HogelRange{3, 0, 1, 4}, HogelRange{0, 0, 5, 4}}) {
        LightFieldTile tile(grid, range, true), expected(grid, range, true);
        // Whatever the tile held before.
        std::ranges::fill(tile.radiance.elements(), -7.0f);
        std::ranges::fill(tile.depth.elements(), -7.0f);
        renderer->read(tile);
        whole.read(expected);
        EXPECT_TRUE(std::ranges::equal(tile.radiance.elements(), expected.radiance.elements()));
        EXPECT_TRUE(std::ranges::equal(tile.depth.elements(), expected.depth.elements()));
    }
}

TEST_P(EveryRenderer, an_empty_scene_is_background_at_infinity) {
    ShadedScene scene;
    scene.background = {0.1f, 0.2f, 0.3f};
    const LightFieldBuffer seen = render(GetParam(), scene, grid);
    for (float depth : seen.depth.elements()) ASSERT_EQ(depth, std::numeric_limits<float>::infinity());
    for (std::size_t c = 0; c < 3; ++c)
        for (float value : seen.radiance[c].elements()) ASSERT_EQ(value, 0.1f * float(c + 1) + 0.0f) << c;
}

// Whether a sample lies within one sample of a silhouette: a neighbour sees something else, much nearer or farther.
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

// How many samples were compared away from silhouettes, and how many of them show a triangle.
struct Compared {
    std::size_t samples = 0, hits = 0;
};

// Samples less than `margin` from the border of a hogel's view are left out: what is beside them is not known.
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

// The first intersects rays with a hierarchy; the others project and scan convert in different ways and orders.
TEST_P(EveryRenderer, agrees_with_ray_casting_on_random_scenes) {
    std::mt19937 random(1);
    Compared compared;
    // The plain algorithm for whole tiles takes its time.
    const int rounds = GetParam() == "simplex" ? 8 : 40;
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

// Windows as small as they can be into many more scenes, of one triangle and of several.
TEST_P(EveryRenderer, agrees_with_ray_casting_on_2000_random_scenes) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> aside(-0.4, 0.4);
    Compared compared;
    for (int round = 0; round < 2000; ++round) {
        const bool behind = round % 2 == 0;
        ShadedScene scene = random_scene(random, 8, behind);
        if (!behind && !crosses_plane(GetParam())) continue;
        scene.fronts_only = round % 8 >= 4;
        // One kind of triangle after the other by itself, then all together.
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

// The convex hull of points on a ball, by halving the edges of an octahedron, turned at random. The faces' corners go
// round counterclockwise for who looks from outside.
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

// A ray meets a convex body exactly if it is on the inner side of all faces somewhere on its way. Of a body that shows
// the fronts of its faces alone it sees the same, and of one turned inside out the far side.
TEST_P(EveryRenderer, covers_a_closed_body_without_a_gap) {
    std::mt19937 random(3);
    std::size_t inside = 0, outside = 0;
    for (int round = 0; round < (GetParam() == "simplex" ? 1 : 6); ++round) {
        const Vec3 middle{0.2e-3, -0.3e-3, crosses_plane(GetParam()) && round % 2 == 0 ? 0.4e-3 : -4e-3};
        const std::vector<std::array<Vec3, 3>> faces = random_body(random, middle);
        ShadedScene scene;
        for (const auto& [p, q, r] : faces) add_triangle(scene, p, q, r, [](Vec3) { return Rgb{1, 1, 1}; });
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
                            way{grid.u(double(u)), grid.v(double(v)), -1};
                        double enters = -1, leaves = 1;
                        for (const auto& [p, q, r] : faces) {
                            const Vec3 out = cross(q - p, r - p);
                            const double slope = dot(out, way), at = dot(out, p - from) / slope;
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

// Every ray against every triangle, by the test that these renderers apply to the samples that they find: they miss
// none, and order, region and the way of finding leave no trace. The grid has its centre on samples, where rays go
// through vertices and along edges.
class SampleFindingRenderer : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, SampleFindingRenderer,
                         ::testing::Values("simplex", "simploid", "simplex3d", "oblique", "mvr"),
                         [](const auto& parameter) { return test_name(parameter.param); });

TEST_P(SampleFindingRenderer, finds_what_a_test_of_all_rays_against_all_triangles_finds) {
    const LightFieldGrid odd{3, 5, 1_mm, 21, 19, Perspective{0.5, 0.4}, 3};
    std::mt19937 random(5);
    std::uniform_int_distribution<int> step(-4, 4), deeper(1, 6);
    const int rounds = GetParam() == "simplex" ? 10 : 40;
    for (int round = 0; round < rounds; ++round) {
        const bool behind = !crosses_plane(GetParam()) || round % 4 < 2;
        ShadedScene scene = random_scene(random, 16, behind);
        // Half of the scenes have all vertices on a lattice of half hogels and millimetres of depth.
        if (round % 2 == 0)
            for (Vec3& p : scene.positions)
                p = {0.5e-3 * step(random), 0.5e-3 * step(random), 1e-3 * (behind ? -deeper(random) : step(random))};
        scene.fronts_only = round % 8 >= 4;
        const double least = crosses_plane(GetParam()) ? -1 : simplex::near_plane(scene, GetParam());
        LightFieldBuffer expected(odd, true);
        LightFieldTile tile(odd, {0, 0, odd.hogels_s, odd.hogels_t}, true);
        for (std::size_t t = 0; t < odd.hogels_t; ++t)
            for (std::size_t s = 0; s < odd.hogels_s; ++s)
                for (std::size_t v = 0; v < odd.directions_v; ++v)
                    for (std::size_t u = 0; u < odd.directions_u; ++u) {
                        NearestTriangle seen;
                        for (std::uint32_t i : triangles_with_area(scene))
                            see(seen, i, ObliqueTriangle(scene, i, odd.u(double(u)), odd.v(double(v))),
                                odd.s(double(s)), odd.t(double(t)), least);
                        store(tile, scene, odd, seen, t, s, v, u);
                    }
        expected.write(tile);
        const LightFieldBuffer found = render(GetParam(), scene, odd);
        ASSERT_TRUE(std::ranges::equal(found.radiance.elements(), expected.radiance.elements())) << round;
        ASSERT_TRUE(std::ranges::equal(found.depth.elements(), expected.depth.elements())) << round;
    }
}

TEST(Renderers, that_need_the_scene_behind_the_plane_say_so_and_name_one_that_does_not) {
    ShadedScene scene;
    add_triangle(scene, {0, 0, -1e-3}, {1e-3, 0, -1e-3}, {0, 1e-3, 2e-3}, [](Vec3) { return Rgb{1, 1, 1}; });
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

// A flake in front of the middle of a hogel, at twice and at half of a millionth of the scene's size.
TEST(Renderers, that_need_the_scene_behind_the_plane_see_up_to_their_near_plane) {
    const double size = 8e-3, near = 1e-6 * size;
    for (double depth : {2 * near, 0.5 * near}) {
        const Vec3 p{grid.s(1), grid.t(2), -depth};
        ShadedScene scene;
        add_triangle(scene, {-1e-3, 0, -size}, {1e-3, 0, -size}, {0, 1e-6, -size}, [](Vec3) { return Rgb{1, 1, 1}; });
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

// Triangles much smaller than the distance between hogels, in front of the hologram, in it and behind it.
TEST(Renderers, agree_on_a_fine_mesh_around_the_hologram) {
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
    const LightFieldBuffer first = render(names()[0], scene, grid);
    for (std::size_t other = 1; other < names().size(); ++other) {
        if (!crosses_plane(names()[other])) continue;
        const LightFieldBuffer second = render(names()[other], scene, grid);
        std::size_t hits = 0, different = 0;
        for (std::size_t i = 0; i < first.depth.size(); ++i) {
            const float a = first.depth.data()[i], b = second.depth.data()[i];
            hits += std::isfinite(a) ? 1 : 0;
            if (std::isfinite(a) != std::isfinite(b) || (std::isfinite(a) && std::abs(a - b) > 1e-7f)) ++different;
        }
        EXPECT_GT(hits, 5000u);
        // Only a ray along a silhouette may be seen one way or the other.
        EXPECT_LE(different, 1u) << names()[other];
    }
}

// A sloping quadrilateral with a picture on it beside a plain triangle, in one channel and in three.
TEST(Renderers, agree_on_textures_with_and_without_depth) {
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
    for (const std::size_t channels : {1, 3}) {
        LightFieldGrid sampled = grid;
        sampled.channels = channels;
        const LightFieldBuffer first = render(names()[0], scene, sampled);
        for (std::size_t other = 1; other < names().size(); ++other) {
            if (!crosses_plane(names()[other])) continue;
            const auto source = make_renderer(names()[other], std::make_shared<const ShadedScene>(scene), sampled);
            LightFieldTile tile(sampled, {0, 0, grid.hogels_s, grid.hogels_t}, false);
            source->read(tile);
            std::size_t different = 0;
            for (std::size_t i = 0; i < tile.radiance.size(); ++i)
                if (std::abs(tile.radiance.data()[i] - first.radiance.data()[i]) > 1e-4f) ++different;
            // Only a ray along an edge may be seen one way or the other.
            EXPECT_LE(different, 2 * channels) << names()[other];
        }
    }
}

TEST(Renderers, an_unknown_name_is_a_usage_error_that_lists_the_known_ones) {
    try {
        make_renderer("radiosity", std::make_shared<const ShadedScene>(), grid);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find("raytrace, zbuffer"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace hogel::render
