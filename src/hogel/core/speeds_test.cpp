// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/speeds.h"

#include <gtest/gtest.h>

#include <numeric>

#include "hogel/core/unequal_parts.h"

namespace hogel::core {
namespace {

TEST(Speeds, parts_of_work_let_all_end_together) {
    const std::vector<double> speeds{0.1, 0.2, 0.3, 0.4}, before{0.2, 0, 9, 1};
    const std::vector<double> parts = parts_after(speeds, before, 4);
    // Without the third, which has done too much: (0.2 + 0 + 1 + 4)/0.7 s.
    for (const std::size_t process : {0, 1, 3})
        EXPECT_NEAR((before[process] + 4 * parts[process]) / speeds[process], 5.2 / 0.7, 1e-12);
    EXPECT_EQ(parts[2], 0);
    const std::vector<double> free = parts_after(speeds, {0, 0, 0, 0}, 7);
    for (std::size_t process = 0; process < 4; ++process) EXPECT_NEAR(free[process], speeds[process], 1e-12);
}

TEST(Speeds, lines_in_parts_are_all_lines_in_their_order) {
    for (const std::size_t lines : {0, 1, 7, 100}) {
        std::size_t next = 0;
        for (std::size_t process = 0; process < 4; ++process) {
            const LineRange own = lines_in_parts({0.1, 0, 0.65, 0.25}, process, lines);
            EXPECT_EQ(own.first, next);
            next = own.end();
        }
        EXPECT_EQ(next, lines);
    }
    EXPECT_EQ(lines_in_parts({0.1, 0, 0.65, 0.25}, 2, 100).count, 65u);
    EXPECT_EQ(lines_in_parts({0.1, 0, 0.65, 0.25}, 1, 100).count, 0u);
}

TEST(Speeds, parts_are_equal_where_nobody_says_otherwise) {
    {
        const UnequalParts parts({0.25, 0.75}, {1, 0});
        EXPECT_EQ(parts_by_speed(2), (std::vector<double>{0.25, 0.75}));
        EXPECT_EQ(first_parts(2), (std::vector<double>{1, 0}));
    }
    EXPECT_EQ(parts_by_speed(2), (std::vector<double>{0.5, 0.5}));
    EXPECT_EQ(first_parts(2), (std::vector<double>{0.5, 0.5}));
}

}  // namespace
}  // namespace hogel::core
