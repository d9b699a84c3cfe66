// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/strip.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "hogel/units.h"

namespace hogel::simplex {
namespace {

using namespace literals;

const LightFieldGrid grid{8, 6, 1_mm, 32, 24, Perspective{0.5, 0.4}, 1};
const HogelRange range{2, 1, 4, 3};
const DeepTriangle triangle{{{-2e-3, 1e-3, 5e-3}, {3e-3, 0, 9e-3}, {0, 4e-3, 6e-3}}};

std::vector<Simplex<4>> volume(std::size_t corners) {
    const std::vector<CameraPoint> pentagon{{0, 0}, {2, -0.3}, {3, 1}, {2.2, 2}, {0.1, 1.4}};
    std::vector<Simplex<4>> simplices;
    append_projected_volume(triangle, {pentagon.begin(), pentagon.begin() + std::ptrdiff_t(corners)}, grid, range,
                            simplices);
    return simplices;
}

// [K] 7.2.2: the simplices of a polygon "can always be sorted into one or two such strips".
TEST(Strip, of_a_simploid_needs_two_and_has_each_corner_once) {
    Strip<4> strip;
    EXPECT_EQ(into_strips(volume(3), strip), 2u);
    EXPECT_EQ(strip.points.size(), 9u);
    EXPECT_EQ(strip.simplices.size(), 6u);
    EXPECT_LE(into_strips(volume(4), strip), 4u);
    EXPECT_EQ(strip.points.size(), 12u);
    EXPECT_EQ(strip.simplices.size(), 12u);
    const std::vector<Simplex<4>> simplices = volume(5);
    into_strips(simplices, strip);
    std::multiset<std::set<ProjectedPoint>> before, after;
    for (const auto& simplex : simplices) before.insert({simplex.begin(), simplex.end()});
    for (const auto& corners : strip.simplices) {
        std::set<ProjectedPoint> points;
        for (const std::uint16_t corner : corners) points.insert(strip.points[corner]);
        after.insert(points);
    }
    EXPECT_EQ(before, after);
}

// The slices of a strip equal the slices of its simplices.
TEST(Strip, slices_are_those_of_its_simplices) {
    const std::vector<Simplex<4>> simplices = volume(5);
    using Piece = std::array<ProjectedPoint, 3>;
    const auto sorted = [](Piece piece) {
        std::ranges::sort(piece);
        return piece;
    };
    std::multiset<std::pair<std::pair<std::size_t, std::size_t>, Piece>> one_by_one, together;
    std::vector<std::uint8_t> seen_v(grid.directions_v, 1), seen_u(grid.directions_u, 1);
    seen_v[grid.directions_v / 2] = seen_u[grid.directions_u / 3] = 0;
    for (const Simplex<4>& simplex : simplices)
        slice_at_samples(simplex, axis::v, seen_v, [&](double v, const Simplex<3>& at_v) {
            slice_at_samples(at_v, axis::u, seen_u, [&](double u, const Simplex<2>& at_uv) {
                one_by_one.insert({{std::size_t(v), std::size_t(u)}, sorted(at_uv)});
            });
        });
    StripSlices slices;
    std::size_t points = 0;
    slices.for_each(simplices, {seen_v, seen_u}, [&](std::size_t v, std::size_t u, const Strip<2>& at_uv) {
        points += at_uv.points.size();
        for (const auto& corners : at_uv.simplices)
            together.insert(
                {{v, u}, sorted({at_uv.points[corners[0]], at_uv.points[corners[1]], at_uv.points[corners[2]]})});
    });
    ASSERT_GT(one_by_one.size(), 500u);
    EXPECT_EQ(one_by_one, together);
    EXPECT_LT(2 * points, 3 * together.size()) << "corners are shared";
}

}  // namespace
}  // namespace hogel::simplex
