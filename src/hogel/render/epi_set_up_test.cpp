#include "hogel/render/epi_set_up_internal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <random>

#include "hogel/render/test_triangles_internal.h"

namespace hogel {
namespace {

// The vector kernels as built for each instruction set that this processor has.
class SetUpOnEveryTarget : public KernelTargetTest {};
INSTANTIATE_TEST_SUITE_P(SetUp, SetUpOnEveryTarget, ::testing::ValuesIn(kernel_targets()));

const LightFieldGrid grid{9, 8, 0.5e-3, 20, 31, 0.5, 0.4, 3};

PlaneRays rays_of(const EpipolarFrame& frame, std::size_t t, std::size_t v, std::size_t first, std::size_t columns) {
    const EpipolarFrame::Plane place = frame.plane(t, v);
    const double n = frame.first_column() + double(first), K = frame.first_direction();
    return {place.row, place.slope, place.shift, place.z0, n, n + double(columns) - 1, K, -K, frame.metres(1)};
}

TEST(ClustersCrossed, are_all_that_show_and_few_others) {
    const EpipolarFrame frame(grid);
    const TriangleClusters clusters(scattered_triangles(6000, 0.4e-3), frame, 3);
    std::size_t shown = 0, in_vain = 0, passed_over = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t v = 0; v < grid.directions_v; ++v)
            for (const std::size_t first : {0, 3, 6}) {
                const PlaneRays rays = rays_of(frame, t, v, first, 3);
                std::vector<std::uint32_t> crossed;
                clusters_crossed_plain(clusters.bounds, rays, crossed);
                std::vector<std::uint64_t> words(3 * grid.directions_u + EpipolarPlane::spare);
                for (std::uint32_t i = 0; i < clusters.corners.size(); ++i) {
                    const bool listed = std::ranges::binary_search(crossed, i);
                    std::vector<std::uint32_t> places;
                    const std::uint64_t bits = crossing_plain(clusters.corners[i], rays.row, rays.slope);
                    for (std::uint32_t j = 0; j < cluster_size; ++j)
                        if (bits >> j & 1) places.push_back(i * cluster_size + j);
                    std::vector<Strip> strips(places.size());
                    std::vector<StripShades> shades(places.size());
                    set_up_plain(clusters, places, rays, strips.data(), shades.data(), nullptr);
                    std::ranges::fill(words, EpipolarPlane::nothing);
                    draw_plain(
                        strips, 1,
                        {words.data(), nullptr, 3, grid.directions_u, std::int32_t(rays.n_first), float(rays.K_first)});
                    const bool shows =
                        std::ranges::any_of(words, [](std::uint64_t word) { return word != EpipolarPlane::nothing; });
                    ASSERT_TRUE(listed || !shows) << t << " " << v << " " << first << " " << i;
                    (shows ? shown : listed ? in_vain : passed_over) += 1;
                }
            }
    EXPECT_GT(shown, 1000u);
    EXPECT_GT(passed_over, 2 * shown);
    EXPECT_LT(in_vain, 2 * shown);
}

TEST_P(SetUpOnEveryTarget, vector_and_plain_lists_of_clusters_are_the_same) {
    const EpipolarFrame frame(grid);
    for (const std::size_t triangles : {64, 640, 6000}) {
        const TriangleClusters clusters(scattered_triangles(triangles, 0.4e-3), frame, 3);
        std::size_t listed = 0;
        for (std::size_t t = 0; t < grid.hogels_t; ++t)
            for (std::size_t v = 0; v < grid.directions_v; ++v) {
                const PlaneRays rays = rays_of(frame, t, v, t % 7, 2);
                std::vector<std::uint32_t> fast{7}, plain{7};
                clusters_crossed(clusters.bounds, rays, fast);
                clusters_crossed_plain(clusters.bounds, rays, plain);
                ASSERT_EQ(fast, plain) << triangles << " " << t << " " << v;
                listed += plain.size() - 1;
            }
        EXPECT_GT(listed, 0u);
    }
}

TEST_P(SetUpOnEveryTarget, vector_and_plain_crossings_are_the_same) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> anywhere(-25, 25);
    const auto whole_or_half = [&] { return 0.5 * double(random() % 40) - 10; };
    const auto place = [&] { return random() % 3 == 0 ? whole_or_half() : anywhere(random); };
    const auto corners = std::make_unique<ClusterCorners>();
    std::size_t crossed = 0;
    for (int round = 0; round < 200; ++round) {
        for (int corner = 0; corner < 3; ++corner)
            for (std::size_t i = 0; i < cluster_size; ++i) {
                corners->y[corner][i] = place();
                corners->z[corner][i] = place();
            }
        const double row = whole_or_half(), slope = whole_or_half();
        const std::uint64_t bits = crossing(*corners, row, slope);
        EXPECT_EQ(bits, crossing_plain(*corners, row, slope)) << round;
        crossed += std::size_t(std::popcount(bits));
    }
    EXPECT_GT(crossed, 1000u);
}

TEST(Crossing, a_plane_crosses_the_triangles_with_corners_on_both_sides_and_a_corner_in_it_is_above) {
    const auto corners = std::make_unique<ClusterCorners>();
    const auto triangle = [&](std::size_t i, double a, double b, double c) {
        const double heights[] = {a, b, c};
        for (int corner = 0; corner < 3; ++corner) {
            corners->z[corner][i] = corner + 1.0;
            corners->y[corner][i] = heights[corner] + 3 + 2 * (corner + 1.0);
        }
    };
    for (std::size_t i = 0; i < cluster_size; ++i) triangle(i, 1, 2, 3);
    triangle(0, -1, -2, -3);
    triangle(5, -1, 0, 1);
    triangle(17, 0, 0, -1);
    triangle(62, 0, 1, 0);
    triangle(63, 1, -1, 1);
    const std::uint64_t expected = std::uint64_t{1} << 5 | std::uint64_t{1} << 17 | std::uint64_t{1} << 63;
    EXPECT_EQ(crossing_plain(*corners, 3, 2), expected);
    EXPECT_EQ(crossing(*corners, 3, 2), expected);
}

TEST_P(SetUpOnEveryTarget, vector_and_plain_strips_are_the_same) {
    const EpipolarFrame frame(grid);
    const TriangleClusters clusters(scattered_triangles(700, 0.4e-3), frame, 3);
    std::size_t strips = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t v = 0; v < grid.directions_v; ++v) {
            PlaneRays rays = rays_of(frame, t, v, 0, 9);
            rays.shift = 0.25;
            rays.z0 = 0.1 * double(v);
            std::vector<std::uint32_t> places;
            for (std::uint32_t i = 0; i < clusters.corners.size(); ++i) {
                const std::uint64_t bits = crossing_plain(clusters.corners[i], rays.row, rays.slope);
                for (std::uint32_t j = 0; j < cluster_size; ++j)
                    if (bits >> j & 1) places.push_back(i * cluster_size + j);
            }
            const std::size_t count = places.size(), beyond = 3;
            strips += count;
            std::vector<Strip> fast(count + beyond), plain(count + beyond);
            std::vector<StripShades> fast_shades(count + beyond), plain_shades(count + beyond);
            std::vector<StripOrigin> fast_origins(count), plain_origins(count);
            set_up(clusters, places, rays, fast.data(), fast_shades.data(), fast_origins.data());
            set_up_plain(clusters, places, rays, plain.data(), plain_shades.data(), plain_origins.data());
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
}  // namespace hogel
