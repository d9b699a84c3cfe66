// SPDX-License-Identifier: Apache-2.0
// Light fields with a fixed focal plane, resampled to directions in common.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hogel/error.h"
#include "hogel/light_field.h"

namespace hogel::lightfield {
namespace {

// Seven by five hogels, so that one is in the middle of the hologram. Steps are 0.2 in U and V.
LightFieldGrid grid_with(double focal_plane) {
    return {7, 5, 1e-3, 8, 6, FocalPlane{{0.8, 0.6, 0.1, -0.3}, focal_plane}, 3};
}

LightFieldBuffer numbered(const LightFieldGrid& grid) {
    LightFieldBuffer field(grid, true);
    for (std::size_t i = 0; i < field.radiance.size(); ++i) field.radiance.data()[i] = static_cast<float>(i + 1);
    for (std::size_t i = 0; i < field.depth.size(); ++i) field.depth.data()[i] = -static_cast<float>(i);
    return field;
}

LightFieldBuffer resampled(const LightField& light_field) {
    LightFieldBuffer result(light_field.grid(), true);
    copy(light_field.front(), result);
    return result;
}

// If neighbouring hogels differ by a whole step, resampling moves samples without interpolation.
TEST(CommonDirections, move_samples_by_whole_steps_without_a_change) {
    for (const double focal : {-5e-3, 5e-3}) {
        const LightFieldGrid grid = grid_with(focal), common = common_directions(grid);
        ASSERT_TRUE(common.is_perspective());
        ASSERT_EQ(common.directions_u, 8u + 6u);
        ASSERT_EQ(common.directions_v, 6u + 4u);
        EXPECT_NEAR(common.step_u(), 0.2, 1e-15);
        EXPECT_DOUBLE_EQ(common.center_u(), 0.1);
        EXPECT_DOUBLE_EQ(common.center_v(), -0.3);
        const LightFieldBuffer from = numbered(grid), to = resampled(with_common_directions(borrow(from)));
        ASSERT_EQ(to.grid(), common);
        for (std::size_t t = 0; t < 5; ++t)
            for (std::size_t s = 0; s < 7; ++s) {
                // Behind the hologram, hogels on the right see the points of the plane farther to the left.
                const std::size_t first_u = focal > 0 ? 6 - s : s, first_v = focal > 0 ? 4 - t : t;
                for (std::size_t v = 0; v < 10; ++v)
                    for (std::size_t u = 0; u < 14; ++u) {
                        const bool inside = u >= first_u && u < first_u + 8 && v >= first_v && v < first_v + 6;
                        for (std::size_t c = 0; c < 3; ++c)
                            ASSERT_NEAR(to.radiance(c, t, s, v, u),
                                        inside ? from.radiance(c, t, s, v - first_v, u - first_u) : 0, 0.02)
                                << s << " " << t << " " << u << " " << v;
                        ASSERT_EQ(to.depth(t, s, v, u), inside ? from.depth(t, s, v - first_v, u - first_u)
                                                               : std::numeric_limits<float>::infinity());
                    }
            }
    }
}

// Radiance that is linear in U and V is reproduced for any shift.
TEST(CommonDirections, keep_what_is_linear_in_direction) {
    for (const double focal : {-31e-3, 9.7e-3}) {
        const LightFieldGrid grid = grid_with(focal), common = common_directions(grid);
        LightFieldBuffer from(grid, true);
        const auto value = [](double U, double V) { return 3 + U - 2 * V; };
        for (std::size_t t = 0; t < 5; ++t)
            for (std::size_t s = 0; s < 7; ++s) {
                const LightFieldGrid own = grid.of_hogel(double(s), double(t));
                for (std::size_t v = 0; v < 6; ++v)
                    for (std::size_t u = 0; u < 8; ++u)
                        from.radiance(0, t, s, v, u) = static_cast<float>(value(own.u(double(u)), own.v(double(v))));
            }
        const LightFieldBuffer to = resampled(with_common_directions(borrow(from)));
        std::size_t compared = 0;
        for (std::size_t t = 0; t < 5; ++t)
            for (std::size_t s = 0; s < 7; ++s) {
                const LightFieldGrid own = grid.of_hogel(double(s), double(t));
                for (std::size_t v = 0; v < common.directions_v; ++v)
                    for (std::size_t u = 0; u < common.directions_u; ++u) {
                        const double U = common.u(double(u)), V = common.v(double(v));
                        if (own.column(U) < 0 || own.column(U) > 7 || own.row(V) < 0 || own.row(V) > 5) continue;
                        ASSERT_NEAR(to.radiance(0, t, s, v, u), value(U, V), 1e-5);
                        ++compared;
                    }
            }
        EXPECT_GT(compared, 700u);
    }
}

TEST(CommonDirections, any_range_has_the_samples_of_the_whole) {
    const LightFieldGrid grid = grid_with(-13e-3);
    const LightFieldBuffer from = numbered(grid);
    const LightField common = with_common_directions(borrow(from));
    const LightFieldBuffer whole = resampled(common);
    for (const HogelRange range : {HogelRange{2, 1, 3, 2}, HogelRange{6, 4, 1, 1}, HogelRange{0, 3, 7, 1}}) {
        LightFieldTile tile(common.grid(), range, true), expected(common.grid(), range, true);
        common.front().read(tile);
        whole.read(expected);
        EXPECT_TRUE(std::ranges::equal(tile.radiance.elements(), expected.radiance.elements()));
        EXPECT_TRUE(std::ranges::equal(tile.depth.elements(), expected.depth.elements()));
    }
}

// With horizontal parallax only, a row of directions has no height that could be shifted.
TEST(CommonDirections, keep_a_single_row_of_directions) {
    LightFieldGrid grid = grid_with(-5e-3);
    grid.directions_v = 1;
    const LightFieldGrid common = common_directions(grid);
    EXPECT_EQ(common.directions_v, 1u);
    EXPECT_DOUBLE_EQ(common.half_v(), grid.half_v());
    const LightFieldBuffer from = numbered(grid), to = resampled(with_common_directions(borrow(from)));
    for (std::size_t t = 0; t < 5; ++t)
        EXPECT_NEAR(to.radiance(0, t, 3, 0, 5), from.radiance(0, t, 3, 0, 2), 1e-3) << t;
}

TEST(CommonDirections, are_there_already_without_a_fixed_focal_plane) {
    LightFieldGrid grid = grid_with(1);
    const LightFieldBuffer through_plane(grid);
    grid.view = Perspective{0.8, 0.6};
    const LightFieldBuffer field(grid);
    const LightField light_field = borrow(field);
    EXPECT_EQ(&with_common_directions(light_field).front(), &light_field.front());
    EXPECT_EQ(common_directions(grid), grid);
    EXPECT_THROW(with_common_directions(light_field, grid), Error);
    EXPECT_THROW(with_common_directions(borrow(through_plane), through_plane.grid()), Error);
    LightFieldGrid other = grid;
    other.hogels_s = 3;
    EXPECT_THROW(with_common_directions(borrow(through_plane), other), Error);
    EXPECT_EQ(with_common_directions(borrow(through_plane), grid).grid(), grid);
    // More directions than can be addressed, because the plane is very near.
    EXPECT_THROW(common_directions(grid_with(1e-30)), Error);
}

}  // namespace
}  // namespace hogel::lightfield
