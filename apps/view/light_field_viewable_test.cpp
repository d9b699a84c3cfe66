// SPDX-License-Identifier: Apache-2.0
#include "view/light_field_viewable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "hogel/error.h"

namespace hogel::view {
namespace {

constexpr double behind = 3e-3;  // ζ of the picture

// A light field of a picture of fine stripes on a plane behind the hologram, with or without its depth.
LightField stripes(bool with_depth) {
    const LightFieldGrid grid{80, 60, 0.1e-3, 24, 20, Perspective{0.12, 0.1}, 1};
    auto buffer = std::make_shared<LightFieldBuffer>(grid, with_depth);
    for (std::size_t t = 0; t < 60; ++t)
        for (std::size_t s = 0; s < 80; ++s)
            for (std::size_t v = 0; v < 20; ++v)
                for (std::size_t u = 0; u < 24; ++u) {
                    const double x = grid.s(static_cast<double>(s)) + grid.u(static_cast<double>(u)) * behind;
                    const double y = grid.t(static_cast<double>(t)) + grid.v(static_cast<double>(v)) * behind;
                    buffer->radiance(0, t, s, v, u) =
                        static_cast<float>(1 + 0.5 * std::sin(9000 * x) + 0.4 * std::cos(8000 * y));
                    if (with_depth) buffer->depth(t, s, v, u) = static_cast<float>(behind);
                }
    return LightField(buffer);
}

LightFieldViewable viewable(bool with_depth) { return {stripes(with_depth), stripes(with_depth), 1 << 28, {}}; }

PictureQuery view_from(Vec3 eye) {
    PictureQuery query;
    query.camera.eye = eye;
    query.camera.resolution = {80, 60};
    return query;
}

TEST(LightFieldViewable, focuses_at_the_depth_that_is_known) {
    EXPECT_NEAR(viewable(true).focus(view_from({0, 0, 0.1}), {0.5, 0.5}, {}), behind, 1e-9);
}

TEST(LightFieldViewable, focuses_where_pixels_are_sharpest_otherwise) {
    LightFieldViewable one = viewable(false);
    for (const double x : {-4e-3, 0.0, 5e-3})
        EXPECT_NEAR(one.focus(view_from({x, 0, 0.1}), {0.4, 0.6}, {}), behind, 0.15e-3) << x;
}

// The ray through a pixel is that of the camera: from the eye to the pixel's point of the hologram.
TEST(LightFieldViewable, reads_the_ray_that_a_pixel_shows) {
    LightFieldViewable one = viewable(true);
    const PictureQuery query = view_from({4e-3, -2e-3, 0.1});
    const Camera camera = one.camera(query);
    for (const auto& [column, row] : {std::pair{0.0, 0.0}, {40.0, 30.0}, {79.0, 59.0}, {12.0, 50.0}}) {
        const Reading reading = one.read(query, {(column + 0.5) / 80, (row + 0.5) / 60});
        EXPECT_NEAR(reading.x, camera.picture.x(column), 1e-12);
        EXPECT_NEAR(reading.y, camera.picture.y(row), 1e-12);
        EXPECT_NEAR(std::tan(reading.across), (reading.x - 4e-3) / 0.1, 1e-12);
        EXPECT_NEAR(std::tan(reading.up), (reading.y + 2e-3) / 0.1, 1e-12);
        ASSERT_TRUE(reading.inside);
        EXPECT_EQ(reading.depth, static_cast<double>(static_cast<float>(behind)));
        const double x = reading.x + std::tan(reading.across) * behind, y = reading.y + std::tan(reading.up) * behind;
        EXPECT_NEAR(reading.radiance[0], 1 + 0.5 * std::sin(9000 * x) + 0.4 * std::cos(8000 * y), 0.35);
        EXPECT_EQ(reading.radiance[0], reading.radiance[2]);
    }
    EXPECT_FALSE(one.read(view_from({50e-3, 0, 0.1}), {0.5, 0.5}).inside);
}

TEST(LightFieldViewable, pictures_equal_those_of_photograph) {
    LightFieldViewable one = viewable(false);
    PictureQuery query = view_from({3e-3, 1e-3, 0.12});
    query.pupil_samples = 7;
    const Camera camera = one.camera(query);
    const Image expected = photograph(stripes(false), {&camera, 1}, {.pupil_samples = 7}).front();
    EXPECT_TRUE(
        std::ranges::equal(one.photograph(query, Progress()).picture.pixels.elements(), expected.pixels.elements()));
}

TEST(LightFieldViewable, two_eyes_see_two_pictures) {
    LightFieldViewable one = viewable(true);
    PictureQuery both = view_from({3e-3, 1e-3, 0.12});
    both.eyes = 4e-3;
    const Image pair = one.photograph(both, Progress()).picture;
    ASSERT_EQ(pair.width(), 160u);
    for (const int side : {-1, 1}) {
        const double x = side < 0 ? 1e-3 : 5e-3, first = side < 0 ? 0 : 0.5;
        const Image alone = one.photograph(view_from({x, 1e-3, 0.12}), Progress()).picture;
        const std::size_t begin = side < 0 ? 0 : 80;
        for (std::size_t row = 0; row < 60; ++row)
            for (std::size_t column = 0; column < 80; ++column)
                ASSERT_EQ(pair.pixels(row, begin + column, 0), alone.pixels(row, column, 0)) << side << row << column;
        const Reading reading = one.read(both, {first + 0.125, 0.5}),
                      expected = one.read(view_from({x, 1e-3, 0.12}), {0.25, 0.5});
        EXPECT_EQ(reading.across, expected.across);
        EXPECT_EQ(reading.radiance, expected.radiance);
        EXPECT_NEAR(one.focus(both, {first + 0.125, 0.5}, {}), behind, 1e-9);
    }
}

TEST(LightFieldViewable, refuses_pictures_beyond_any_screen) {
    PictureQuery query = view_from({0, 0, 0.1});
    query.camera.resolution = {4096, 4096};
    EXPECT_THROW(viewable(false).camera(query), Error);
    std::stop_source stopped;
    stopped.request_stop();
    LightFieldViewable one = viewable(false);
    EXPECT_THROW(one.photograph(view_from({0, 0, 0.1}), Progress(stopped.get_token())), Error);
}

TEST(LightFieldViewable, steps_make_light_fields_fit) {
    LightFieldGrid grid{640, 640, 1e-3, 64, 64, Perspective{0.1, 0.1}, 3};
    for (const double memory : {1e7, 1e9, 4e9, 2e10}) {
        const std::size_t step = step_that_fits(grid, static_cast<std::size_t>(memory));
        EXPECT_EQ(step % 2, 1u);
        const double n = std::ceil(640.0 / static_cast<double>(step));
        EXPECT_LE(n * n * 64 * 64 * 3 * 2, 1.1 * memory);
    }
    EXPECT_EQ(step_that_fits(grid, std::size_t{20} << 30), 1u);
    grid.hogels_s = grid.hogels_t = 20;
    EXPECT_EQ(step_of_first_look(grid), 1u);
}

}  // namespace
}  // namespace hogel::view
