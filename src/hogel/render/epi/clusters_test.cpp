// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hogel/render/epi/clusters.h"
#include "hogel/render/epi/setup.h"
#include "hogel/render/epi/test_triangles.h"

namespace hogel::render::epi {
namespace {

const LightFieldGrid grid{9, 8, 0.5e-3, 20, 31, Perspective{0.5, 0.4}, 3};

TEST(TriangleClusters, hold_every_triangle_once_with_its_corners) {
    const ShadedScene scene = scattered_triangles(1000, 0.1e-3);
    const EpipolarFrame frame(grid);
    const TriangleClusters clusters(scene, frame, 3);
    ASSERT_EQ(clusters.triangles.size(), 1000u);
    std::vector<std::uint32_t> sorted = clusters.triangles;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t i = 0; i < 1000; ++i) {
        EXPECT_EQ(sorted[i], i);
        for (int corner = 0; corner < 3; ++corner)
            EXPECT_EQ(clusters.corners[i].radiance[std::size_t(corner)],
                      (Rgb{float(clusters.triangles[i]), float(corner), 0}));
        const Vec3 first = frame.in_samples(scene.positions[3 * clusters.triangles[i]]);
        EXPECT_EQ(clusters.corners[i].x[0], first.x);
        EXPECT_EQ(clusters.corners[i].y[0], first.y);
        EXPECT_EQ(clusters.corners[i].z[0], first.z);
    }
}

TEST(TriangleClusters, are_sorted_by_depth_and_lie_in_their_boxes) {
    const EpipolarFrame frame(grid);
    const TriangleClusters clusters(scattered_triangles(1000, 0.1e-3), frame, 3);
    for (std::size_t i = 0; i < 1000; ++i) {
        const ClusterBox& box = clusters.boxes[i / cluster_size];
        for (int corner = 0; corner < 3; ++corner) {
            const double y = clusters.corners[i].y[corner], z = clusters.corners[i].z[corner];
            EXPECT_TRUE(box.y_low <= y && y <= box.y_high && box.z_low <= z && z <= box.z_high);
            EXPECT_TRUE(box.x_low <= clusters.corners[i].x[corner] && clusters.corners[i].x[corner] <= box.x_high);
        }
    }
    // The last cluster holds the remainder and is not sorted.
    for (std::size_t i = 2; i < clusters.boxes.size(); ++i)
        EXPECT_TRUE(i - 1 == clusters.fronts || clusters.boxes[i - 2].z_low <= clusters.boxes[i - 1].z_low) << i;
    EXPECT_EQ(clusters.occupied(0), ~std::uint64_t{0});
    EXPECT_EQ(clusters.occupied(1000 / cluster_size), (std::uint64_t{1} << 1000 % cluster_size) - 1);
}

// In the middle direction a triangle's front is visible if the span's end 0 is to the left of end 1.
TEST(TriangleClusters, come_with_fronts_before_backs) {
    for (const LightFieldGrid& g : hemicube({9, 8, 0.5e-3, 20, 30, Perspective{1, 1}, 3})) {
        const EpipolarFrame frame(g);
        const TriangleClusters clusters(scattered_triangles(1000, 0.4e-3), frame, 3);
        ASSERT_GT(clusters.fronts, 4u);
        ASSERT_LT(clusters.fronts, clusters.boxes.size() - 4);
        std::size_t spans = 0, mixed = 0;
        // The last cluster of fronts, and the last cluster of all, may contain both fronts and backs.
        for (std::uint32_t i = 0; i < cluster_size * (clusters.boxes.size() - 1); ++i) {
            const TriangleCorners& own = clusters.corners[i];
            const double middle = (own.y[0] + own.y[1] + own.y[2]) / 3;
            EpiSpan span;
            SpanValues values;
            set_up_spans_plain(clusters, {&i, 1}, {middle, 0, 0, 0, 1}, &span, &values, nullptr);
            if (span.x0 == empty_span.x0 || std::abs(span.x1 - span.x0) < 1e-3f) continue;
            mixed += (span.x0 < span.x1) != (i < clusters.fronts * cluster_size);
            ++spans;
        }
        EXPECT_GT(spans, 500u);
        EXPECT_LT(mixed, cluster_size);
    }
}

TEST(TriangleClusters, round_heights_to_the_nearest_step_of_the_box) {
    const TriangleClusters clusters(scattered_triangles(1000, 0.1e-3), EpipolarFrame(grid), 3);
    for (std::size_t i = 0; i < 1000; ++i) {
        const ClusterBox& box = clusters.boxes[i / cluster_size];
        const ClusterHeights& heights = clusters.heights[i / cluster_size];
        const double y_step = (box.y_high - box.y_low) / ClusterHeights::steps;
        const double z_step = (box.z_high - box.z_low) / ClusterHeights::steps;
        for (int corner = 0; corner < 3; ++corner) {
            const double y = box.y_low + y_step * heights.y[corner][i % cluster_size];
            const double z = box.z_low + z_step * heights.z[corner][i % cluster_size];
            EXPECT_NEAR(y, clusters.corners[i].y[corner], 0.5001 * y_step);
            EXPECT_NEAR(z, clusters.corners[i].z[corner], 0.5001 * z_step);
        }
    }
}

TEST(TriangleClusters, may_be_flat) {
    ShadedScene scene = scattered_triangles(3, 0.1e-3);
    for (Vec3& p : scene.positions) p.y = p.z = 1e-3;
    const TriangleClusters clusters(scene, EpipolarFrame(grid), 3);
    EXPECT_EQ(clusters.heights[0].y[2][1], 0);
    EXPECT_EQ(clusters.heights[0].z[2][1], 0);
}

TEST(TriangleClusters, hold_luminance_for_one_channel) {
    const TriangleClusters clusters(scattered_triangles(10, 0.1e-3), EpipolarFrame(grid), 1);
    for (std::size_t i = 0; i < 10; ++i)
        EXPECT_FLOAT_EQ(clusters.corners[i].radiance[1].r, 0.2126f * float(clusters.triangles[i]) + 0.7152f);
}

// A ray of any face is in its epipolar plane, at its column and direction.
TEST(EpipolarFrame, holds_each_ray_in_its_plane_column_and_direction) {
    LightFieldGrid aside = grid;
    aside.range().center_u = 0.3;
    aside.range().center_v = -0.2;
    std::vector<LightFieldGrid> grids{grid, {8, 9, 0.5e-3, 21, 30, Perspective{0.5, 0.4}, 3}, aside};
    for (const LightFieldGrid& face : hemicube({8, 9, 0.5e-3, 20, 30, Perspective{1, 1}, 3})) grids.push_back(face);
    for (const LightFieldGrid& g : grids) {
        const EpipolarFrame frame(g);
        const HogelRange all{0, 0, g.hogels_s, g.hogels_t};
        for (std::size_t i = 0; i < frame.axes().fast_hogels(all); ++i)
            for (std::size_t k = 0; k < frame.axes().fast_directions(); ++k) {
                const auto [t, s, v, u] = frame.axes().sample(2, i, 5, k);
                const Vec3 ray = g.direction_of(g.u(double(u)), g.v(double(v)));
                const double length = 3e-3;
                const Vec3 p = frame.in_samples(
                    {g.s(double(s)) + length * ray.x, g.t(double(t)) + length * ray.y, -length * ray.z});
                const EpipolarFrame::Plane plane = frame.plane(2, 5);
                const double x = p.x + plane.shift, z = p.z - plane.z0;
                EXPECT_NEAR(x - (frame.first_direction() + double(k)) * z, frame.first_column() + double(i), 1e-11);
                EXPECT_NEAR(p.y - plane.slope * p.z, plane.row, 1e-11);
                EXPECT_NEAR(frame.metres(z), length, 1e-14);
                EXPECT_NEAR(plane.depth_per_forward, ray.z, 1e-14);
            }
    }
}

}  // namespace
}  // namespace hogel::render::epi
