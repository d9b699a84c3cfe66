#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "hogel/render/epi_clusters_internal.h"
#include "hogel/render/epi_kernels_internal.h"

namespace hogel {
namespace {

const LightFieldGrid grid{9, 8, 0.5e-3, 20, 31, 0.5, 0.4, 3};

ShadedScene scattered_triangles(std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-4e-3, 4e-3), size(-0.1e-3, 0.1e-3);
    ShadedScene scene;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 middle{place(random), place(random), place(random)};
        for (int corner = 0; corner < 3; ++corner) {
            scene.positions.push_back(middle + Vec3{size(random), size(random), size(random)});
            scene.radiance.push_back({float(i), float(corner), 0});
        }
        scene.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, ShadedScene::no_texture, 0});
    }
    return scene;
}

TEST(TriangleClusters, hold_every_triangle_once_with_its_corners) {
    const ShadedScene scene = scattered_triangles(1000);
    const EpipolarFrame frame(grid);
    const TriangleClusters clusters(scene, frame);
    ASSERT_EQ(clusters.triangles.size(), 1000u);
    std::vector<std::uint32_t> sorted = clusters.triangles;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t i = 0; i < 1000; ++i) {
        EXPECT_EQ(sorted[i], i);
        for (int corner = 0; corner < 3; ++corner)
            EXPECT_EQ(clusters.others[i].radiance[std::size_t(corner)],
                      (Rgb{float(clusters.triangles[i]), float(corner), 0}));
        const Vec3 first = frame.in_samples(scene.positions[3 * clusters.triangles[i]]);
        EXPECT_EQ(clusters.others[i].x[0], first.x);
        EXPECT_EQ(clusters.corners[i / cluster_size].y[0][i % cluster_size], first.y);
        EXPECT_EQ(clusters.corners[i / cluster_size].z[0][i % cluster_size], first.z);
    }
}

TEST(TriangleClusters, are_passed_over_only_if_no_triangle_is_crossed_and_mostly_then) {
    const EpipolarFrame frame(grid);
    const TriangleClusters clusters(scattered_triangles(6000), frame);
    const auto group_of = [&](std::size_t cluster) -> const TriangleClusters::Group& {
        for (const auto& group : clusters.groups)
            if (std::ranges::count(group.clusters, cluster) == 1) return group;
        throw std::logic_error("a cluster without a group");
    };
    std::size_t crossed = 0, passed_over = 0, in_vain = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t v = 0; v < grid.directions_v; ++v) {
            const EpipolarFrame::Plane plane = frame.plane(t, v);
            for (std::size_t i = 0; i < clusters.corners.size(); ++i) {
                const bool meets = crossing_plain(clusters.corners[i], plane.row, plane.slope) != 0;
                const bool may = clusters.bounds[i].may_cross(plane.row, plane.slope);
                ASSERT_TRUE(may || !meets) << t << " " << v << " " << i;
                ASSERT_TRUE(group_of(i).bounds.may_cross(plane.row, plane.slope) || !meets);
                (meets ? crossed : may ? in_vain : passed_over) += 1;
            }
        }
    EXPECT_GT(crossed, 1000u);
    EXPECT_GT(passed_over, 2 * crossed);
    EXPECT_LT(in_vain, crossed);
}

// The points of a ray of any face lie in its epipolar plane, and the ray is straight there.
TEST(EpipolarFrame, counts_in_samples) {
    LightFieldGrid aside = grid;
    aside.center_u = 0.3;
    aside.center_v = -0.2;
    std::vector<LightFieldGrid> grids{grid, {8, 9, 0.5e-3, 21, 30, 0.5, 0.4, 3}, aside};
    for (const LightFieldGrid& face : hemicube({8, 9, 0.5e-3, 20, 30, 1, 1, 3})) grids.push_back(face);
    for (const LightFieldGrid& g : grids) {
        const EpipolarFrame frame(g);
        const HogelRange all{0, 0, g.hogels_s, g.hogels_t};
        for (std::size_t i = 0; i < frame.axes().fast_hogels(all); ++i)
            for (std::size_t k = 0; k < frame.axes().fast_directions(); ++k) {
                const auto [t, s, v, u] = frame.axes().sample(2, i, 5, k);
                const Vec3 way = g.along(g.u(double(u)), g.v(double(v)));
                const double steps = 3e-3;
                const Vec3 p =
                    frame.in_samples({g.s(double(s)) + steps * way.x, g.t(double(t)) + steps * way.y, -steps * way.z});
                const EpipolarFrame::Plane plane = frame.plane(2, 5);
                const double x = p.x + plane.shift, z = p.z - plane.z0;
                EXPECT_NEAR(x - (frame.first_direction() + double(k)) * z, frame.first_column() + double(i), 1e-11);
                EXPECT_NEAR(p.y - plane.slope * p.z, plane.row, 1e-11);
                EXPECT_NEAR(frame.metres(z), steps, 1e-14);
                EXPECT_NEAR(plane.deepening, way.z, 1e-14);
            }
    }
}

}  // namespace
}  // namespace hogel
