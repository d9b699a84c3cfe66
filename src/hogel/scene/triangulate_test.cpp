// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hogel::scene {
namespace {

/// Expects triangles in the polygon's orientation whose areas add up to its area: a tiling.
void expect_tiling(const std::vector<Vec3>& polygon) {
    Vec3 whole;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        whole += 0.5 * cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    const auto triangles = triangulate(polygon);
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
    Vec3 sum;
    for (const auto& [a, b, c] : triangles) {
        const Vec3 area = 0.5 * cross(polygon[b] - polygon[a], polygon[c] - polygon[a]);
        EXPECT_GE(dot(area, whole), 0);
        sum += area;
    }
    EXPECT_NEAR(length(sum - whole), 0, 1e-12 * length(whole));
}

std::vector<Vec3> placed(std::vector<Vec3> polygon, Vec3 right, Vec3 up) {
    for (Vec3& p : polygon) p = p.x * right + p.y * up + Vec3{3, -2, 5};
    return polygon;
}

TEST(Triangulate, tiles_polygons_of_any_shape_and_orientation) {
    std::vector<Vec3> star, comb{{0, -1, 0}, {20, -1, 0}};
    for (int i = 0; i < 40; ++i) {
        const double r = i % 2 == 0 ? 1 : 0.2, angle = 6.283185307 * i / 40;
        star.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    for (int i = 20; i >= 0; --i) comb.push_back({static_cast<double>(i), i % 2 == 0 ? 5.0 : 0.0, 0});
    const std::vector<std::vector<Vec3>> shapes{
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
        {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},  // a corner on a straight side
        {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}},             // a concave quadrilateral
        star,
        comb};
    const std::vector<std::array<Vec3, 2>> frames{{{{1, 0, 0}, {0, 1, 0}}},   {{{0, 1, 0}, {1, 0, 0}}},
                                                  {{{0, 1, 0}, {0, 0, 1}}},   {{{0, 0, 1}, {0, 1, 0}}},
                                                  {{{0, 0, 1}, {1, 0, 0}}},   {{{1, 0, 0}, {0, 0, 1}}},
                                                  {{{1, 0.5, 0}, {0, 1, 2}}}, {{{-1, 0.3, 0.2}, {0, 0.1, -1}}}};
    for (const auto& shape : shapes)
        for (const auto& [right, up] : frames) expect_tiling(placed(shape, right, up));
}

TEST(Triangulate, ends_for_degenerate_polygons) {
    EXPECT_TRUE(triangulate({}).empty());
    EXPECT_EQ(triangulate(std::vector<Vec3>(10)).size(), 8u);
    const std::vector<Vec3> bow{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(triangulate(bow).size(), 2u);
}

}  // namespace
}  // namespace hogel::scene
