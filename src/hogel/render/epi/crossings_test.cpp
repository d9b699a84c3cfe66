// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "hogel/render/epi/setup.h"
#include "hogel/render/test_triangles.h"

namespace hogel::render::epi {
namespace {

// The vector kernels as built for each instruction set that this processor has.
class CrossingsOnEveryTarget : public KernelTargetTest {};
INSTANTIATE_TEST_SUITE_P(Crossings, CrossingsOnEveryTarget, ::testing::ValuesIn(kernel_targets()));

// Light fields whose planes are found alike: the front, directions to one side, a side of a hemicube, and more
// directions than a slab has.
std::vector<LightFieldGrid> grids() {
    const LightFieldGrid front{9, 8, 0.5e-3, 20, 31, Perspective{0.5, 0.4}, 3};
    LightFieldGrid aside = front, tall = front;
    aside.range().center_v = -0.7;
    tall.directions_v = 300;
    const std::vector<LightFieldGrid> cube = hemicube({8, 9, 0.5e-3, 20, 30, Perspective{1, 1}, 3});
    return {front, aside, tall, cube[1], cube[3]};
}

RowRays rays_of(const EpipolarFrame& frame, std::size_t row, std::size_t planes, std::size_t first,
                std::size_t columns) {
    const EpipolarFrame::Plane place = frame.plane(row, 0), next = frame.plane(row, 1);
    const double n = frame.first_column() + double(first), K = frame.first_direction();
    return {place.row + place.slope * place.z0,
            place.z0,
            place.slope,
            next.slope - place.slope,
            std::min(RowRays::max_planes, planes),
            place.shift,
            n,
            n + double(columns) - 1,
            K,
            -K};
}

bool separates(const EpipolarFrame::Plane& plane, const TriangleCorners& corners) {
    int below = 0;
    for (int i = 0; i < 3; ++i) below += (corners.y[i] - plane.slope * corners.z[i]) - plane.row < 0;
    return below % 3 != 0;
}

// Triangles all around the hologram plane, from tiny ones to such that span all of a cluster.
TEST(Crossings, are_all_that_show_and_few_others) {
    std::size_t shown = 0;
    for (const LightFieldGrid& grid : grids())
        for (const double reach : {0.02e-3, 0.4e-3, 3e-3}) {
            const EpipolarFrame frame(grid);
            const TriangleClusters clusters(scattered_triangles(4000, reach), frame, 3);
            const std::size_t planes = frame.axes().slow_directions(), directions = frame.axes().fast_directions();
            std::size_t crossed = 0, found = 0;
            for (const std::size_t row : {0, 3, 6}) {
                const RowRays rays = rays_of(frame, row, planes, 3, 3);
                Crossings crossings;
                find_crossings_plain(clusters, rays, crossings);
                ASSERT_EQ(crossings.size(), rays.planes);
                for (std::size_t k = 0; k < rays.planes; k += 3) {
                    ASSERT_TRUE(std::ranges::is_sorted(crossings[k], {}, &Crossing::cluster));
                    std::vector<bool> listed(clusters.triangles.size());
                    for (const auto& [triangles, cluster] : crossings[k]) {
                        ASSERT_EQ(triangles & ~clusters.filled(cluster), 0u);
                        for (std::size_t i = 0; i < cluster_size; ++i)
                            if (triangles >> i & 1) listed[cluster * cluster_size + i] = true;
                    }
                    const EpipolarFrame::Plane plane = frame.plane(row, k);
                    const PlanePlace place{plane.row, plane.slope, plane.shift, plane.z0, frame.metres(1)};
                    for (std::uint32_t i = 0; i < clusters.triangles.size(); ++i) {
                        found += listed[i];
                        if (!separates(plane, clusters.corners[i])) continue;
                        crossed += listed[i];
                        Strip strip;
                        StripShades shades;
                        set_up_plain(clusters, {&i, 1}, place, &strip, &shades, nullptr);
                        std::vector<std::uint64_t> words(3 * directions, EpipolarPlane::nothing);
                        draw_plain(
                            {&strip, 1}, 1,
                            {words.data(), nullptr, 3, directions, std::int32_t(rays.n_first), float(rays.K_first)});
                        const bool shows = std::ranges::any_of(
                            words, [](std::uint64_t word) { return word != EpipolarPlane::nothing; });
                        ASSERT_TRUE(listed[i] || !shows) << row << " " << k << " " << i;
                        shown += shows;
                    }
                }
            }
            EXPECT_GT(crossed, 20u);
            EXPECT_LT(found, crossed + crossed / 2) << int(grid.face()) << " " << reach;
        }
    EXPECT_GT(shown, 1000u);
}

TEST(Crossings, a_box_is_met_where_its_only_point_is_seen_and_nowhere_far_from_there) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> anywhere(-50, 50);
    for (int round = 0; round < 1000; ++round) {
        const double x = anywhere(random), z = 0.1 * anywhere(random), slope = anywhere(random), K = anywhere(random);
        const double n = x - K * z, row = 3;
        ClusterBox box;
        box.include({x, row + slope * z, z});
        const auto met = [&](double slopes_from, double n_from) {
            return may_meet(box, {row, 0, slopes_from, -0.5, 3, 0, n_from, n_from + 4, K, K});
        };
        for (const double i : {0, 1, 2})
            for (const double columns : {0, 2, 4}) EXPECT_TRUE(met(slope + 0.5 * i, n - columns)) << round;
        EXPECT_FALSE(met(slope, n + 1.1) || met(slope, n - 5.1)) << round;
        EXPECT_FALSE(std::abs(z) > 1e-3 && (met(slope + 1.1, n) || met(slope - 0.1, n))) << round;
    }
}

// Triangles that a plane only just separates, of which clusters hold quite different ones.
TEST(Crossings, miss_no_narrow_one) {
    const LightFieldGrid grid{9, 8, 0.5e-3, 20, 200, Perspective{0.5, 0.4}, 3};
    const EpipolarFrame frame(grid);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> depth(0.5e-3, 9e-3), height(-1e-9, 1e-9);
    ShadedScene scene;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const double v = grid.v(double(random() % 200));
        for (int corner = 0; corner < 3; ++corner) {
            const double forward = depth(random);
            scene.positions.push_back({0, grid.t(4) + v * forward + height(random) * grid.pitch, -forward});
            scene.radiance.push_back({});
        }
        scene.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, ShadedScene::no_texture, 0});
    }
    const TriangleClusters clusters(scene, frame, 3);
    Crossings crossings;
    find_crossings_plain(clusters, rays_of(frame, 4, 200, 0, 9), crossings);
    std::size_t narrow = 0;
    for (std::size_t k = 0; k < 200; ++k)
        for (std::uint32_t i = 0; i < 2000; ++i) {
            if (!separates(frame.plane(4, k), clusters.corners[i])) continue;
            ++narrow;
            const bool listed = std::ranges::any_of(crossings[k], [i](const Crossing& crossing) {
                return crossing.cluster == i / cluster_size && (crossing.triangles >> i % cluster_size & 1) != 0;
            });
            ASSERT_TRUE(listed) << k << " " << i;
        }
    EXPECT_GT(narrow, 1000u);
}

// Of triangles that do not touch the hologram plane hardly one is found in vain.
TEST(Crossings, are_nearly_exact_behind_the_hologram) {
    const LightFieldGrid grid{9, 8, 0.5e-3, 20, 200, Perspective{0.5, 0.4}, 3};
    const EpipolarFrame frame(grid);
    ShadedScene scene = scattered_triangles(5000, 0.05e-3);
    for (Vec3& p : scene.positions) p.z -= 8e-3;
    const TriangleClusters clusters(scene, frame, 3);
    Crossings crossings;
    find_crossings_plain(clusters, rays_of(frame, 4, 200, 0, 9), crossings);
    std::size_t found = 0, in_vain = 0;
    for (std::size_t k = 0; k < 200; ++k)
        for (const auto& [triangles, cluster] : crossings[k])
            for (std::size_t i = 0; i < cluster_size; ++i) {
                if ((triangles >> i & 1) == 0) continue;
                ++found;
                in_vain += !separates(frame.plane(4, k), clusters.corners[cluster * cluster_size + i]);
            }
    EXPECT_GT(found, 4000u);
    EXPECT_LT(in_vain, found / 200);
}

TEST_P(CrossingsOnEveryTarget, vector_and_plain_ones_are_the_same) {
    for (const LightFieldGrid& grid : grids())
        for (const double reach : {0.02e-3, 0.4e-3, 3e-3}) {
            const EpipolarFrame frame(grid);
            const TriangleClusters clusters(scattered_triangles(700, reach), frame, 3);
            for (std::size_t row = 0; row < 8; ++row) {
                const RowRays rays = rays_of(frame, row, frame.axes().slow_directions(), row % 7, 2);
                Crossings fast(300, {{1, 1}}), plain;
                find_crossings(clusters, rays, fast);
                find_crossings_plain(clusters, rays, plain);
                ASSERT_EQ(fast.size(), plain.size());
                for (std::size_t k = 0; k < plain.size(); ++k)
                    ASSERT_TRUE(std::ranges::equal(fast[k], plain[k],
                                                   [](const Crossing& a, const Crossing& b) {
                                                       return a.cluster == b.cluster && a.triangles == b.triangles;
                                                   }))
                        << row << " " << k;
            }
        }
}

}  // namespace
}  // namespace hogel::render::epi
