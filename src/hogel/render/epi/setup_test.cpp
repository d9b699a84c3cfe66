// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <random>

#include "hogel/core/test_targets.h"
#include "hogel/render/epi/test_triangles.h"

namespace hogel::render::epi {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(SetUpKernels);

const LightFieldGrid grid{9, 8, 0.5e-3, 20, 31, Perspective{0.5, 0.4}, 3};

CutPlane cut_plane(const EpipolarFrame& frame, std::size_t t, std::size_t v) {
    const EpipolarFrame::Plane plane = frame.plane(t, v);
    return {plane.row, plane.slope, plane.shift, plane.z0, frame.metres(1)};
}

// The span of a triangle whose corners have these heights above the plane y = 3 + 2 z.
EpiSpan span_of(double a, double b, double c) {
    ShadedScene scene = scattered_triangles(1, 0.1e-3);
    TriangleClusters clusters(scene, EpipolarFrame(grid), 3);
    const double heights[] = {a, b, c};
    for (int corner = 0; corner < 3; ++corner) {
        clusters.corners[0].z[corner] = corner + 1.0;
        clusters.corners[0].y[corner] = heights[corner] + 3 + 2 * (corner + 1.0);
        clusters.corners[0].x[corner] = corner % 2;
    }
    const std::uint32_t slot = 0;
    EpiSpan fast, plain;
    SpanValues values;
    set_up_spans(clusters, {&slot, 1}, {3, 2, 0, 0, 1}, &fast, &values, nullptr);
    set_up_spans_plain(clusters, {&slot, 1}, {3, 2, 0, 0, 1}, &plain, &values, nullptr);
    EXPECT_EQ(std::memcmp(&fast, &plain, sizeof(EpiSpan)), 0);
    return fast;
}

TEST_P(SetUpKernels, triangles_with_corners_on_both_sides_are_crossed_and_corners_in_the_plane_are_above) {
    const auto crossed = [](double a, double b, double c) { return span_of(a, b, c).x0 != empty_span.x0; };
    EXPECT_TRUE(crossed(-1, 0, 1));
    EXPECT_TRUE(crossed(0, 0, -1));
    EXPECT_TRUE(crossed(1, -1, 1));
    EXPECT_FALSE(crossed(1, 2, 3));
    EXPECT_FALSE(crossed(-1, -2, -3));
    EXPECT_FALSE(crossed(0, 1, 0));
    EXPECT_FALSE(crossed(0, 0, 0));
}

TEST_P(SetUpKernels, vector_and_plain_twins_agree) {
    const EpipolarFrame frame(grid);
    const TriangleClusters clusters(scattered_triangles(700, 0.4e-3), frame, 3);
    std::size_t spans = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t v = 0; v < grid.directions_v; ++v) {
            CutPlane plane = cut_plane(frame, t, v);
            plane.shift = 0.25;
            plane.z0 = 0.1 * double(v);
            // Triangles that the plane crosses, and some that it does not.
            std::vector<std::uint32_t> slots;
            for (std::uint32_t i = 0; i < clusters.corners.size(); ++i) {
                std::size_t below = 0;
                for (int corner = 0; corner < 3; ++corner)
                    below += clusters.corners[i].y[corner] - plane.slope * clusters.corners[i].z[corner] < plane.row;
                if (below % 3 != 0 || (i + t + v) % 23 == 0) slots.push_back(i);
            }
            const std::size_t count = slots.size(), padding = 3;
            spans += count;
            std::vector<EpiSpan> fast(count + padding), plain(count + padding);
            std::vector<SpanValues> fast_values(count + padding), plain_values(count + padding);
            std::vector<SpanOrigin> fast_origins(count), plain_origins(count);
            set_up_spans(clusters, slots, plane, fast.data(), fast_values.data(), fast_origins.data());
            set_up_spans_plain(clusters, slots, plane, plain.data(), plain_values.data(), plain_origins.data());
            const auto same = [](const auto& a, const auto& b) {
                return std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
            };
            ASSERT_TRUE(same(fast, plain)) << t << " " << v;
            ASSERT_TRUE(same(fast_values, plain_values)) << t << " " << v;
            ASSERT_TRUE(same(fast_origins, plain_origins)) << t << " " << v;
        }
    EXPECT_GT(spans, 1000u);
}

}  // namespace
}  // namespace hogel::render::epi
