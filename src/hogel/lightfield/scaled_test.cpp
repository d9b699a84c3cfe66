// SPDX-License-Identifier: Apache-2.0
// Light fields at another scale.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/error.h"
#include "hogel/light_field.h"

namespace hogel::lightfield {
namespace {

constexpr double no_plane = std::numeric_limits<double>::infinity();

LightFieldGrid grid_through(double focal_plane) {
    const DirectionRange range{0.05, 0.04, 0.01, 0};
    if (std::isfinite(focal_plane)) return {7, 5, 30e-6, 8, 6, FocalPlane{range, focal_plane}, 1};
    return {7, 5, 30e-6, 8, 6, Perspective{range}, 1};
}

// Returns x at a depth on the ray of a hogel's column of directions.
double x_of(const LightFieldGrid& grid, double hogel, double column, double depth) {
    return grid.s(hogel) + grid.of_hogel(hogel, 2).u(column) * depth;
}

// Returns how many hogels apart neighbouring directions see the point at a depth on the ray of hogel 3, column 4.
double disparity(const LightFieldGrid& grid, double depth) {
    const double x = x_of(grid, 3, 4, depth), x0 = x_of(grid, 0, 5, depth), x1 = x_of(grid, 1, 5, depth);
    return (x - x0) / (x1 - x0) - 3;
}

LightFieldBuffer with_depth(const LightFieldGrid& grid, float depth) {
    LightFieldBuffer field(grid, true);
    for (std::size_t i = 0; i < field.radiance.size(); ++i) field.radiance.data()[i] = static_cast<float>(i);
    std::ranges::fill(field.depth.elements(), depth);
    return field;
}

TEST(ScaledLightFields, keep_samples_and_disparities) {
    for (const double plane : {no_plane, -0.3, 0.2})
        for (const double depth : {-5e-3, 0.0, 2e-3, 40e-3}) {
            SCOPED_TRACE(testing::Message() << plane << " " << depth);
            const LightFieldGrid grid = grid_through(plane);
            const LightFieldBuffer from = with_depth(grid, static_cast<float>(depth));
            const LightField scaled = with_scale(borrow(from), 16e-6, 0.25);
            LightFieldBuffer to(scaled.grid(), true);
            copy(scaled.front(), to);
            EXPECT_TRUE(to.grid().is_perspective());
            EXPECT_DOUBLE_EQ(to.grid().pitch, 16e-6);
            EXPECT_DOUBLE_EQ(to.grid().half_v(), 0.01);
            EXPECT_DOUBLE_EQ(to.grid().center_u(), 0.0025);
            EXPECT_TRUE(std::ranges::equal(to.radiance.elements(), from.radiance.elements()));
            EXPECT_NEAR(disparity(to.grid(), to.depth(1, 2, 3, 4)), disparity(grid, depth), 1e-4);
        }
}

TEST(ScaledLightFields, have_no_depth_at_and_beyond_the_focal_plane) {
    const LightFieldBuffer from = with_depth(grid_through(0.2), 0.2f);
    const LightField scaled = with_scale(borrow(from), 16e-6, 1);
    LightFieldBuffer to(scaled.grid(), true);
    copy(scaled.front(), to);
    EXPECT_EQ(to.depth(0, 0, 0, 0), std::numeric_limits<float>::infinity());
}

TEST(ScaledLightFields, refuse_scales_that_are_not_positive) {
    const LightFieldBuffer from(grid_through(no_plane));
    EXPECT_THROW(with_scale(borrow(from), 0, 1), Error);
    EXPECT_THROW(with_scale(borrow(from), 1e-6, -1), Error);
}

}  // namespace
}  // namespace hogel::lightfield
