// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/crossed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "hogel/core/test_targets.h"
#include "hogel/render/epi/setup.h"
#include "hogel/render/epi/test_triangles.h"

namespace hogel::render::epi {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(CrossedKernels);

// Grids of the front, off-centre, with more directions than RowPlanes, and of sides of a hemicube.
std::vector<LightFieldGrid> grids() {
    const LightFieldGrid front{9, 8, 0.5e-3, 20, 31, Perspective{0.5, 0.4}, 3};
    LightFieldGrid aside = front, tall = front;
    aside.range().center_v = -0.7;
    tall.directions_v = 300;
    const std::vector<LightFieldGrid> cube = hemicube({8, 9, 0.5e-3, 20, 30, Perspective{1, 1}, 3});
    return {front, aside, tall, cube[1], cube[3]};
}

RowPlanes row_planes(const EpipolarFrame& frame, std::size_t row, std::size_t planes, std::size_t first,
                     std::size_t columns) {
    const EpipolarFrame::Plane plane = frame.plane(row, 0), next = frame.plane(row, 1);
    const double n = frame.first_column() + double(first), K = frame.first_direction();
    return {plane.row + plane.slope * plane.z0,
            plane.z0,
            plane.slope,
            next.slope - plane.slope,
            std::min(RowPlanes::max_planes, planes),
            plane.shift,
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

// Triangles around the hologram plane, from tiny ones to those as large as a cluster.
TEST(CrossedTriangles, hold_all_that_show_and_few_others) {
    std::size_t shown = 0;
    for (const LightFieldGrid& grid : grids())
        for (const double size : {0.02e-3, 0.4e-3, 3e-3}) {
            const EpipolarFrame frame(grid);
            const TriangleClusters clusters(scattered_triangles(4000, size), frame, 3);
            const std::size_t planes = frame.axes().slow_directions(), directions = frame.axes().fast_directions();
            std::size_t separated = 0, found = 0;
            for (const std::size_t row : {0, 3, 6}) {
                const RowPlanes tested = row_planes(frame, row, planes, 3, 3);
                CrossedByPlane crossed;
                find_crossed_plain(clusters, tested, crossed);
                ASSERT_EQ(crossed.size(), tested.count);
                for (std::size_t k = 0; k < tested.count; k += 3) {
                    ASSERT_TRUE(std::ranges::is_sorted(crossed[k], {}, &CrossedTriangles::cluster));
                    std::vector<bool> listed(clusters.triangles.size());
                    for (const auto& [triangles, cluster] : crossed[k]) {
                        ASSERT_EQ(triangles & ~clusters.occupied(cluster), 0u);
                        for (std::size_t i = 0; i < cluster_size; ++i)
                            if (triangles >> i & 1) listed[cluster * cluster_size + i] = true;
                    }
                    const EpipolarFrame::Plane plane = frame.plane(row, k);
                    const CutPlane cut{plane.row, plane.slope, plane.shift, plane.z0, frame.metres(1)};
                    for (std::uint32_t i = 0; i < clusters.triangles.size(); ++i) {
                        found += listed[i];
                        if (!separates(plane, clusters.corners[i])) continue;
                        separated += listed[i];
                        EpiSpan span;
                        SpanValues values;
                        set_up_spans_plain(clusters, {&i, 1}, cut, &span, &values, nullptr);
                        std::vector<std::uint64_t> words(3 * directions, EpipolarPlane::empty);
                        draw_spans_plain({&span, 1}, 1,
                                         {words.data(), nullptr, 3, directions, std::int32_t(tested.n_first),
                                          float(tested.K_first)});
                        const bool shows =
                            std::ranges::any_of(words, [](std::uint64_t word) { return word != EpipolarPlane::empty; });
                        ASSERT_TRUE(listed[i] || !shows) << row << " " << k << " " << i;
                        shown += shows;
                    }
                }
            }
            EXPECT_GT(separated, 20u);
            EXPECT_LT(found, separated + separated / 2) << int(grid.face()) << " " << size;
        }
    EXPECT_GT(shown, 1000u);
}

TEST(CrossedTriangles, may_show_only_where_their_box_is_seen) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> anywhere(-50, 50);
    for (int round = 0; round < 1000; ++round) {
        const double x = anywhere(random), z = 0.1 * anywhere(random), slope = anywhere(random), K = anywhere(random);
        const double n = x - K * z, row = 3;
        ClusterBox box;
        box.include({x, row + slope * z, z});
        const auto shows = [&](double slopes_from, double n_from) {
            return may_show(box, {row, 0, slopes_from, -0.5, 3, 0, n_from, n_from + 4, K, K});
        };
        for (const double i : {0, 1, 2})
            for (const double columns : {0, 2, 4}) EXPECT_TRUE(shows(slope + 0.5 * i, n - columns)) << round;
        EXPECT_FALSE(shows(slope, n + 1.1) || shows(slope, n - 5.1)) << round;
        EXPECT_FALSE(std::abs(z) > 1e-3 && (shows(slope + 1.1, n) || shows(slope - 0.1, n))) << round;
    }
}

// Triangles whose corners are very close to a plane, of very different sizes in each cluster.
TEST(CrossedTriangles, include_narrow_ones) {
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
    CrossedByPlane crossed;
    find_crossed_plain(clusters, row_planes(frame, 4, 200, 0, 9), crossed);
    std::size_t narrow = 0;
    for (std::size_t k = 0; k < 200; ++k)
        for (std::uint32_t i = 0; i < 2000; ++i) {
            if (!separates(frame.plane(4, k), clusters.corners[i])) continue;
            ++narrow;
            const bool listed = std::ranges::any_of(crossed[k], [i](const CrossedTriangles& some) {
                return some.cluster == i / cluster_size && (some.triangles >> i % cluster_size & 1) != 0;
            });
            ASSERT_TRUE(listed) << k << " " << i;
        }
    EXPECT_GT(narrow, 1000u);
}

// If no triangle touches the hologram plane, there are hardly any false positives.
TEST(CrossedTriangles, are_nearly_exact_behind_the_hologram) {
    const LightFieldGrid grid{9, 8, 0.5e-3, 20, 200, Perspective{0.5, 0.4}, 3};
    const EpipolarFrame frame(grid);
    ShadedScene scene = scattered_triangles(5000, 0.05e-3);
    for (Vec3& p : scene.positions) p.z -= 8e-3;
    const TriangleClusters clusters(scene, frame, 3);
    CrossedByPlane crossed;
    find_crossed_plain(clusters, row_planes(frame, 4, 200, 0, 9), crossed);
    std::size_t found = 0, in_vain = 0;
    for (std::size_t k = 0; k < 200; ++k)
        for (const auto& [triangles, cluster] : crossed[k])
            for (std::size_t i = 0; i < cluster_size; ++i) {
                if ((triangles >> i & 1) == 0) continue;
                ++found;
                in_vain += !separates(frame.plane(4, k), clusters.corners[cluster * cluster_size + i]);
            }
    EXPECT_GT(found, 4000u);
    EXPECT_LT(in_vain, found / 200);
}

TEST_P(CrossedKernels, vector_and_plain_twins_agree) {
    for (const LightFieldGrid& grid : grids())
        for (const double size : {0.02e-3, 0.4e-3, 3e-3}) {
            const EpipolarFrame frame(grid);
            const TriangleClusters clusters(scattered_triangles(700, size), frame, 3);
            for (std::size_t row = 0; row < 8; ++row) {
                const RowPlanes tested = row_planes(frame, row, frame.axes().slow_directions(), row % 7, 2);
                CrossedByPlane fast(300, {{1, 1}}), plain;
                find_crossed(clusters, tested, fast);
                find_crossed_plain(clusters, tested, plain);
                ASSERT_EQ(fast.size(), plain.size());
                for (std::size_t k = 0; k < plain.size(); ++k)
                    ASSERT_TRUE(std::ranges::equal(fast[k], plain[k],
                                                   [](const CrossedTriangles& a, const CrossedTriangles& b) {
                                                       return a.cluster == b.cluster && a.triangles == b.triangles;
                                                   }))
                        << row << " " << k;
            }
        }
}

}  // namespace
}  // namespace hogel::render::epi
