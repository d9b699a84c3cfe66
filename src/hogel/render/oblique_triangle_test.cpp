// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/oblique_triangle.h"

#include <gtest/gtest.h>

#include <random>

namespace hogel::render {
namespace {

std::size_t add_vertex(ShadedScene& scene, Vec3 position) {
    scene.positions.push_back(position);
    scene.radiance.push_back({});
    scene.texture_coordinates.push_back({});
    return scene.positions.size() - 1;
}

void add_triangle(ShadedScene& scene, std::size_t a, std::size_t b, std::size_t c) {
    const auto index = [](std::size_t i) { return static_cast<std::uint32_t>(i); };
    scene.triangles.push_back({{index(a), index(b), index(c)}, ShadedScene::no_texture, 0});
}

// Corners are at whole millimetres, and rays at half millimetres in directions that map corners to corners, so that
// most rays pass through a vertex or along an edge. The depths of corners are random on both sides of the plane, so the
// order of vertices in space is unrelated to their order in the picture.
TEST(ObliqueTriangle, every_ray_through_a_mesh_belongs_to_exactly_one_triangle) {
    constexpr int n = 8;
    std::mt19937 random(3);
    std::uniform_int_distribution<int> depth(-3, 3), shift(-2, 2), coin(0, 1);
    for (int round = 0; round < 50; ++round) {
        const int U = shift(random), V = shift(random);
        ShadedScene scene;
        // Corner (i, j) is on the ray (U, V) through point (i, j) of the plane.
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const int z = depth(random);
                add_vertex(scene, {1e-3 * (i + U * z), 1e-3 * (j + V * z), -1e-3 * z});
            }
        const auto corner = [](int i, int j) { return static_cast<std::size_t>(j * (n + 1) + i); };
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const std::size_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                                  d = corner(i, j + 1);
                // In both orientations, seen from the front.
                if (coin(random) == 0) {
                    add_triangle(scene, a, b, c);
                    add_triangle(scene, a, d, c);
                } else {
                    add_triangle(scene, d, b, a);
                    add_triangle(scene, d, b, c);
                }
            }
        for (int j = 1; j < 2 * n; ++j)
            for (int i = 1; i < 2 * n; ++i) {
                int owners = 0;
                for (std::size_t k = 0; k < scene.triangles.size(); ++k)
                    owners += ObliqueTriangle(scene, k, U, V).at(0.5e-3 * i, 0.5e-3 * j) ? 1 : 0;
                ASSERT_EQ(owners, 1) << U << " " << V << " " << i << " " << j;
            }
    }
}

TEST(ObliqueTriangle, weights_and_depth_are_those_of_a_point_on_the_ray) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> coordinate(-4e-3, 4e-3), weight(0.05, 1), slope(-0.5, 0.5);
    for (int i = 0; i < 1000; ++i) {
        ShadedScene scene;
        for (int k = 0; k < 3; ++k) add_vertex(scene, {coordinate(random), coordinate(random), coordinate(random)});
        add_triangle(scene, 0, 1, 2);
        std::array<double, 3> w{weight(random), weight(random), weight(random)};
        const double sum = w[0] + w[1] + w[2];
        Vec3 p{};
        for (std::size_t k = 0; k < 3; ++k) {
            w[k] /= sum;
            p += w[k] * scene.positions[k];
        }
        const Vec3 &a = scene.positions[0], ab = scene.positions[1] - a, ac = scene.positions[2] - a;
        const double U = slope(random), V = slope(random);
        // For grazing rays the point is ill-conditioned.
        if (std::abs(dot(normalize(cross(ab, ac)), {U, V, -1})) < 0.01 || length(cross(ab, ac)) < 1e-7) continue;
        const ObliqueTriangle::Hit hit = ObliqueTriangle(scene, 0, U, V).at(p.x + U * p.z, p.y + V * p.z);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit.depth, -p.z, 1e-12);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(hit.weights[k], w[k], 1e-8);
    }
}

TEST(ObliqueTriangle, triangles_without_area_are_skipped) {
    ShadedScene scene;
    for (Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{2, 0, 0}, Vec3{0.5, 1e-9, 0}})
        add_vertex(scene, p);
    add_triangle(scene, 0, 1, 3);  // on a line
    add_triangle(scene, 0, 1, 2);
    add_triangle(scene, 1, 1, 2);  // twice the same corner
    add_triangle(scene, 0, 1, 4);  // thin, but with an area
    EXPECT_EQ(triangles_with_area(scene), (std::vector<std::uint32_t>{1, 3}));
}

TEST(ObliqueTriangle, the_nearest_is_seen_and_of_equal_depths_the_first) {
    ShadedScene scene;
    for (double z : {-2.0, -2.0, -1.0})
        for (Vec3 p : {Vec3{-1, -1, z}, Vec3{1, -1, z}, Vec3{0, 1, z}}) add_vertex(scene, p);
    for (std::size_t k = 0; k < 3; ++k) add_triangle(scene, 3 * k, 3 * k + 1, 3 * k + 2);
    NearestTriangle seen;
    const auto show = [&](std::uint32_t k) { see(seen, k, ObliqueTriangle(scene, k, 0, 0), 0, 0, 0.5); };
    show(1);
    show(0);
    EXPECT_EQ(seen.triangle, 1u);
    show(2);
    show(1);
    EXPECT_EQ(seen.triangle, 2u);
    EXPECT_EQ(seen.depth, 1);
    NearestTriangle beyond;
    see(beyond, 2, ObliqueTriangle(scene, 2, 0, 0), 0, 0, 1.5);
    EXPECT_EQ(beyond.triangle, NearestTriangle::none);
}

}  // namespace
}  // namespace hogel::render
