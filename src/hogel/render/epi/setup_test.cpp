// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/epi/setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <random>

#include "hogel/render/test_triangles.h"

namespace hogel::render::epi {
namespace {

// The vector kernels as built for each instruction set that this processor has.
class SetUpOnEveryTarget : public KernelTargetTest {};
INSTANTIATE_TEST_SUITE_P(SetUp, SetUpOnEveryTarget, ::testing::ValuesIn(kernel_targets()));

const LightFieldGrid grid{9, 8, 0.5e-3, 20, 31, Perspective{0.5, 0.4}, 3};

PlanePlace place_of(const EpipolarFrame& frame, std::size_t t, std::size_t v) {
    const EpipolarFrame::Plane place = frame.plane(t, v);
    return {place.row, place.slope, place.shift, place.z0, frame.metres(1)};
}

// One triangle whose corners have these heights above the plane y = 3 + 2 z.
Strip strip_of(double a, double b, double c) {
    ShadedScene scene = scattered_triangles(1, 0.1e-3);
    TriangleClusters clusters(scene, EpipolarFrame(grid), 3);
    const double heights[] = {a, b, c};
    for (int corner = 0; corner < 3; ++corner) {
        clusters.corners[0].z[corner] = corner + 1.0;
        clusters.corners[0].y[corner] = heights[corner] + 3 + 2 * (corner + 1.0);
        clusters.corners[0].x[corner] = corner % 2;
    }
    const std::uint32_t place = 0;
    Strip fast, plain;
    StripShades shades;
    set_up(clusters, {&place, 1}, {3, 2, 0, 0, 1}, &fast, &shades, nullptr);
    set_up_plain(clusters, {&place, 1}, {3, 2, 0, 0, 1}, &plain, &shades, nullptr);
    EXPECT_EQ(std::memcmp(&fast, &plain, sizeof(Strip)), 0);
    return fast;
}

TEST_P(SetUpOnEveryTarget, a_plane_crosses_triangles_with_corners_on_both_sides_and_a_corner_in_it_is_above) {
    const auto crossed = [](double a, double b, double c) { return strip_of(a, b, c).x0 != nowhere.x0; };
    EXPECT_TRUE(crossed(-1, 0, 1));
    EXPECT_TRUE(crossed(0, 0, -1));
    EXPECT_TRUE(crossed(1, -1, 1));
    EXPECT_FALSE(crossed(1, 2, 3));
    EXPECT_FALSE(crossed(-1, -2, -3));
    EXPECT_FALSE(crossed(0, 1, 0));
    EXPECT_FALSE(crossed(0, 0, 0));
}

TEST_P(SetUpOnEveryTarget, vector_and_plain_strips_are_the_same) {
    const EpipolarFrame frame(grid);
    const TriangleClusters clusters(scattered_triangles(700, 0.4e-3), frame, 3);
    std::size_t strips = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t v = 0; v < grid.directions_v; ++v) {
            PlanePlace place = place_of(frame, t, v);
            place.shift = 0.25;
            place.z0 = 0.1 * double(v);
            // Those that the plane crosses, and some others.
            std::vector<std::uint32_t> places;
            for (std::uint32_t i = 0; i < clusters.corners.size(); ++i) {
                std::size_t below = 0;
                for (int corner = 0; corner < 3; ++corner)
                    below += clusters.corners[i].y[corner] - place.slope * clusters.corners[i].z[corner] < place.row;
                if (below % 3 != 0 || (i + t + v) % 23 == 0) places.push_back(i);
            }
            const std::size_t count = places.size(), beyond = 3;
            strips += count;
            std::vector<Strip> fast(count + beyond), plain(count + beyond);
            std::vector<StripShades> fast_shades(count + beyond), plain_shades(count + beyond);
            std::vector<StripOrigin> fast_origins(count), plain_origins(count);
            set_up(clusters, places, place, fast.data(), fast_shades.data(), fast_origins.data());
            set_up_plain(clusters, places, place, plain.data(), plain_shades.data(), plain_origins.data());
            const auto same = [](const auto& a, const auto& b) {
                return std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
            };
            ASSERT_TRUE(same(fast, plain)) << t << " " << v;
            ASSERT_TRUE(same(fast_shades, plain_shades)) << t << " " << v;
            ASSERT_TRUE(same(fast_origins, plain_origins)) << t << " " << v;
        }
    EXPECT_GT(strips, 1000u);
}

}  // namespace
}  // namespace hogel::render::epi
