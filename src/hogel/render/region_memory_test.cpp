// SPDX-License-Identifier: Apache-2.0
#include "hogel/renderer.h"

#include <gtest/gtest.h>

#include <string>

namespace hogel::render {
namespace {

LightFieldGrid grid_of(Face face) {
    LightFieldGrid grid{100, 50, 1e-3, 16, 6, Perspective{0.5, 0.4}, 3};
    std::get<Perspective>(grid.view).face = face;
    return grid;
}

// 8 bytes for each ray of what docs/renderers.md says that a renderer keeps.
TEST(RegionMemory, is_eight_bytes_a_ray_that_is_kept) {
    const LightFieldGrid grid = grid_of(Face::front);
    const HogelRange region{7, 3, 20, 10};
    EXPECT_EQ(renderers().find("simplex").depth_buffer_bytes(grid, region), 8.0 * 20 * 10 * 16 * 6);
    EXPECT_EQ(renderers().find("simploid").depth_buffer_bytes(grid, region), 8.0 * 20 * 10 * 16);
    EXPECT_EQ(renderers().find("simploid").depth_buffer_bytes(grid_of(Face::left), region), 8.0 * 20 * 10 * 6);
    EXPECT_EQ(renderers().find("simplex3d").depth_buffer_bytes(grid, region), 8.0 * 20 * 16 * 6);
    EXPECT_EQ(renderers().find("oblique").depth_buffer_bytes(grid, region), 8.0 * 20 * 10);
    for (const char* name : {"raytrace", "zbuffer", "mvr", "epi"})
        EXPECT_FALSE(renderers().find(name).depth_buffer_bytes) << name;
}

// More than any machine can address: told all the same.
TEST(RegionMemory, of_regions_that_no_machine_can_hold_is_told) {
    LightFieldGrid grid = grid_of(Face::front);
    grid.hogels_s = grid.hogels_t = 1 << 20;
    grid.directions_u = grid.directions_v = 1 << 14;
    EXPECT_EQ(renderers().find("simplex").depth_buffer_bytes(grid, {0, 0, 1 << 20, 1 << 20}), 0x1p71);
}

}  // namespace
}  // namespace hogel::render
