// SPDX-License-Identifier: Apache-2.0
// Work counts of the renderers that share one hit test.
#include "hogel/render/visits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hogel/render/layers.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/test_renderers.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

using namespace literals;

const LightFieldGrid grid{5, 4, 1_mm, 33, 31, Perspective{0.5, 0.4}, 3};

Visits visits_of(const std::string& name, const ShadedScene& scene, const LightFieldGrid& sampled = grid) {
    const auto renderer = make_renderer(name, std::make_shared<const ShadedScene>(scene), sampled);
    LightFieldTile tile(sampled, {0, 0, sampled.hogels_s, sampled.hogels_t}, false);
    renderer->read(tile);
    return dynamic_cast<const CountsVisits&>(without_layers(*renderer)).visits();
}

// Returns the number of pairs of a ray and a triangle that meet.
std::uint64_t hits_of(const ShadedScene& scene) {
    std::uint64_t hits = 0;
    for (const std::uint32_t index : triangles_with_area(scene))
        for (std::size_t v = 0; v < grid.directions_v; ++v)
            for (std::size_t u = 0; u < grid.directions_u; ++u) {
                const ObliqueTriangle triangle(scene, index, grid, double(u), double(v));
                for (std::size_t t = 0; t < grid.hogels_t; ++t)
                    for (std::size_t s = 0; s < grid.hogels_s; ++s)
                        hits += triangle.at(grid.s(double(s)), grid.t(double(t))) ? 1 : 0;
            }
    return hits;
}

class VisitingRenderer : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Renderers, VisitingRenderer,
                         ::testing::Values("simplex", "simplex-strips", "simploid", "simplex3d", "oblique", "mvr"),
                         [](const auto& parameter) { return test_name(parameter.param); });

// Candidates are the rays that meet a triangle, and few others. `simplex` finds a sample on a face between two
// simplices in both, and one triangle may be seen from both sides.
TEST_P(VisitingRenderer, tests_the_rays_that_meet_a_triangle_and_few_others) {
    std::mt19937 random(4);
    std::uint64_t samples = 0, hits = 0;
    for (int round = 0; round < 4; ++round) {
        const ShadedScene scene = random_scene(random, 24, true);
        const Visits visits = visits_of(GetParam(), scene);
        samples += visits.samples;
        hits += hits_of(scene);
        EXPECT_GT(visits.pieces, 0u);
        EXPECT_GT(visits.slices, 0u);
    }
    EXPECT_GT(hits, 10000u);
    EXPECT_GE(samples, hits);
    EXPECT_LE(double(samples), 1.01 * double(hits));
}

// Work grows with the field of view, not with the motion of a triangle's picture from hogel to hogel.
TEST_P(VisitingRenderer, looks_at_no_sample_of_what_is_out_of_view) {
    ShadedScene scene;
    add_triangle(scene, {20e-3, 0, -4e-3}, {30e-3, 0, -4e-3}, {20e-3, 9e-3, -5e-3}, white);
    const Visits visits = visits_of(GetParam(), scene);
    EXPECT_EQ(visits.samples, 0u);
}

// A triangle that no hogel of a tile sees in any direction is not made into a volume, on either side of the view.
TEST(Simplices, are_not_made_of_what_is_out_of_view) {
    for (const char* name : {"simplex", "simplex-strips", "simplex3d"})
        for (const Vec3 away : {Vec3{12e-3, 0, 0}, Vec3{-12e-3, 0, 0}, Vec3{0, 12e-3, 0}, Vec3{0, -12e-3, 0}, Vec3{}}) {
            ShadedScene scene;
            add_triangle(scene, Vec3{0, 0, -4e-3} + away, Vec3{1e-3, 0, -4e-3} + away, Vec3{0, 1e-3, -5e-3} + away,
                         white);
            const Visits visits = visits_of(name, scene);
            EXPECT_EQ(visits.pieces == 0, away != Vec3{}) << name;
            EXPECT_GE(visits.samples, hits_of(scene)) << name;
        }
}

// Small triangles just behind the hologram. Each is visible to distant hogels in only a few directions of its volume.
// Without skipping the other directions, simplices were cut 80 times as often.
TEST(Simplices, smaller_than_the_hogels_are_apart_are_cut_where_hogels_see_them) {
    ShadedScene scene;
    constexpr int side = 40;
    for (int j = 0; j <= side; ++j)
        for (int i = 0; i <= side; ++i)
            add_vertex(scene, {(i - 20.3) * 0.1e-3, (j - 20.4) * 0.1e-3, -0.05e-3 * (1 + (3 * i + 5 * j) % 4)});
    const auto at = [&](int j, int i) { return static_cast<std::uint32_t>(j * (side + 1) + i); };
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            scene.triangles.push_back({{at(j, i), at(j, i + 1), at(j + 1, i)}, ShadedScene::no_texture, 0});
            scene.triangles.push_back({{at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)}, ShadedScene::no_texture, 0});
        }
    const LightFieldGrid sparse{3, 3, 1.3_mm, 16, 16, Perspective{0.36, 0.36}, 3};
    const std::uint64_t rays = sparse.hogels() * sparse.directions();
    for (const char* name : {"simplex", "simplex-strips", "simplex3d"}) {
        const Visits visits = visits_of(name, scene, sparse);
        EXPECT_GE(visits.samples, rays / 2) << name;
        EXPECT_LE(visits.samples, 2 * rays) << name;
        EXPECT_LE(visits.pieces, rays) << name;
        EXPECT_LE(visits.cuts, 60 * rays) << name;
    }
}

// A triangle just behind the hologram moves by thousands of directions from one hogel to the next. The thesis' worst
// case of simplices (7.2.2) came from there.
TEST_P(VisitingRenderer, looks_at_no_more_than_the_field_of_view_of_what_touches_the_hologram) {
    ShadedScene scene;
    add_triangle(scene, {-1e-3, -1e-3, -2e-9}, {1.2e-3, -0.8e-3, -3e-8}, {0.1e-3, 1e-3, -1e-8}, white);
    const Visits visits = visits_of(GetParam(), scene);
    const std::size_t rays = grid.hogels() * grid.directions();
    EXPECT_GE(visits.samples, hits_of(scene));
    EXPECT_LE(visits.samples, 2 * rays);
    EXPECT_LE(visits.slices, 60 * grid.directions());
    if (cuts_simplices(GetParam())) {
        // At most 18 per triangle, [K] fig. 5.22, at any position; the near plane may split one triangle into two.
        EXPECT_LE(visits.pieces, 36u);
    }
}

// Strips share slices between simplices and find the same samples.
TEST(Strips, visit_fewer_slices_than_simplices_do) {
    std::mt19937 random(9);
    const ShadedScene scene = random_scene(random, 24, true);
    const LightFieldGrid dense{16, 16, 0.1_mm, 40, 40, Perspective{0.5, 0.5}, 3};
    const Visits simplices = visits_of("simplex", scene, dense), strips = visits_of("simplex-strips", scene, dense);
    EXPECT_EQ(strips.pieces, simplices.pieces);
    EXPECT_LE(2 * strips.slices, simplices.slices);
    EXPECT_LE(strips.samples, simplices.samples);
}

TEST(CountsVisits, adds_up_tiles) {
    std::mt19937 random(2);
    const auto renderer =
        make_renderer("simploid", std::make_shared<const ShadedScene>(random_scene(random, 8, true)), grid);
    const auto& counter = dynamic_cast<const CountsVisits&>(without_layers(*renderer));
    EXPECT_EQ(counter.visits(), Visits{});
    LightFieldTile tile(grid, {1, 1, 2, 2}, false);
    renderer->read(tile);
    const Visits once = counter.visits();
    renderer->read(tile);
    EXPECT_EQ(counter.visits().samples, 2 * once.samples);
    EXPECT_EQ(counter.visits().pieces, 2 * once.pieces);
}

}  // namespace
}  // namespace hogel::render
