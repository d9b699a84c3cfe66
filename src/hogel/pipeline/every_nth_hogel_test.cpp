// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "hogel/error.h"
#include "hogel/pipeline.h"

namespace hogel::pipeline {
namespace {

// A light field with samples that encode their position: s, t and the direction.
LightField places(std::size_t columns, std::size_t rows) {
    const LightFieldGrid grid{columns, rows, 1e-3, 2, 3, Perspective{0.2, 0.3}, 3};
    auto buffer = std::make_shared<LightFieldBuffer>(grid, true);
    for (std::size_t t = 0; t < rows; ++t)
        for (std::size_t s = 0; s < columns; ++s)
            for (std::size_t v = 0; v < 3; ++v)
                for (std::size_t u = 0; u < 2; ++u) {
                    buffer->radiance(0, t, s, v, u) = static_cast<float>(grid.s(static_cast<double>(s)));
                    buffer->radiance(1, t, s, v, u) = static_cast<float>(grid.t(static_cast<double>(t)));
                    buffer->radiance(2, t, s, v, u) = static_cast<float>(2 * v + u);
                    buffer->depth(t, s, v, u) = static_cast<float>(100 * t + s);
                }
    return LightField(buffer);
}

LightFieldTile whole(const LightField& light_field) {
    const LightFieldGrid& grid = light_field.grid();
    LightFieldTile tile(grid, {0, 0, grid.hogels_s, grid.hogels_t}, true);
    light_field.front().read(tile);
    return tile;
}

// The grid position of each hogel is that of the source hogel, for even and odd numbers and all steps.
TEST(EveryNthHogel, IsWhereItsGridSaysItIs) {
    for (const auto& [columns, rows] : {std::pair<std::size_t, std::size_t>{9, 8}, {7, 12}, {16, 5}, {2, 3}})
        for (std::size_t n = 1; n <= 9; ++n) {
            const LightField few = every_nth_hogel(places(columns, rows), n);
            const LightFieldGrid& grid = few.grid();
            const LightFieldTile tile = whole(few);
            ASSERT_GE(grid.hogels_s, 1u);
            for (std::size_t t = 0; t < grid.hogels_t; ++t)
                for (std::size_t s = 0; s < grid.hogels_s; ++s) {
                    ASSERT_NEAR(tile.radiance(0, t, s, 2, 1), grid.s(static_cast<double>(s)), 1e-9) << columns << n;
                    ASSERT_NEAR(tile.radiance(1, t, s, 2, 1), grid.t(static_cast<double>(t)), 1e-9) << rows << n;
                    ASSERT_EQ(tile.radiance(2, t, s, 2, 1), 5);
                }
        }
}

TEST(EveryNthHogel, SpansWhatItCan) {
    const LightFieldGrid grid = every_nth_hogel(places(16, 15), 3).grid();
    EXPECT_EQ(grid.hogels_s, 6u);  // 0, 3 … 15
    EXPECT_EQ(grid.hogels_t, 5u);  // 1, 4 … 13
    EXPECT_DOUBLE_EQ(grid.pitch, 3e-3);
}

TEST(EveryNthHogel, HasTheDepthOfItsHogels) {
    const LightFieldTile tile = whole(every_nth_hogel(places(9, 9), 4));  // only the middle
    EXPECT_EQ(tile.depth(0, 0, 0, 0), 404);
}

TEST(EveryNthHogel, OfOneIsTheLightFieldItself) {
    const LightField all = places(4, 4);
    EXPECT_EQ(&every_nth_hogel(all, 1).front(), &all.front());
    EXPECT_THROW(every_nth_hogel(all, 0), Error);
}

}  // namespace
}  // namespace hogel::pipeline
