// SPDX-License-Identifier: Apache-2.0
#include "hogel/geometry.h"

#include <gtest/gtest.h>

namespace hogel::math {
namespace {

TEST(Vec3, cross_of_x_and_y_is_z) { EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1})); }

TEST(Grid, the_top_left_sample_has_the_smallest_x_and_the_largest_y) {
    const Grid grid{4, 2, 1e-3, 2e-3, 0.5, -0.5};
    EXPECT_DOUBLE_EQ(grid.x(0), 0.5 - 1.5e-3);
    EXPECT_DOUBLE_EQ(grid.y(0), -0.5 + 1e-3);
    EXPECT_NEAR(grid.column(grid.x(3)), 3, 1e-9);
    EXPECT_NEAR(grid.row(grid.y(1)), 1, 1e-9);
}

}  // namespace
}  // namespace hogel::math
