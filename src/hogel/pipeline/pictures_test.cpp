// SPDX-License-Identifier: Apache-2.0
// Light fields and photographs of pictures.
#include <gtest/gtest.h>

#include <cmath>

#include "hogel/pipeline.h"
#include "hogel/units.h"

namespace hogel::pipeline {
namespace {

using namespace hogel::literals;

constexpr std::size_t size = 48;  // pixels of pictures, hogels

float smooth(std::size_t x, std::size_t y) {
    return 1 + 0.5f * std::sin(0.3f * static_cast<float>(x)) * std::cos(0.2f * static_cast<float>(y));
}

Image smooth_picture() {
    Image picture(size, size, 1);
    for (std::size_t y = 0; y < size; ++y)
        for (std::size_t x = 0; x < size; ++x) picture.pixels(y, x, 0) = smooth(x, y);
    return picture;
}

LightFieldRequest request() {
    LightFieldRequest request;
    request.grid = {size, size, 0.1_mm, 16, 3, field_of_view(20_deg)};
    return request;
}

LightFieldTile rendered(const Scene& scene, const LightFieldRequest& request) {
    const LightField light_field = render_light_field(scene, request);
    LightFieldTile tile(light_field.grid(), {0, 0, size, size}, true);
    light_field.front().read(tile);
    return tile;
}

TEST(Pictures, at_the_hologram_are_photographed_as_they_are) {
    const LightFieldRequest wanted = request();
    const LightField light_field =
        render_light_field(prepare_scene(scene_of_picture(smooth_picture()), wanted), wanted);
    Camera camera = camera_for(4.8_mm, 4.8_mm, size);
    camera.eye = {4_mm, -3_mm, 100_mm};
    const Image photo = photograph(light_field, std::vector{camera}, RayCamera{}).front();
    double sum = 0;
    for (std::size_t y = 1; y + 1 < size; ++y)
        for (std::size_t x = 1; x + 1 < size; ++x)
            sum += std::pow(photo.pixels(y, x, 0) - smooth(x, y), 2) / ((size - 2) * (size - 2));
    EXPECT_LT(std::sqrt(sum), 0.01);
}

// A map of one value at depth z gives the rays of the plain picture, moved to z.
TEST(Pictures, with_one_depth_are_plain_pictures_at_that_depth) {
    const Array<float, 2> map({size / 2, size / 2}, 7.0f);
    for (const double depth : {-2_mm, 3_mm}) {
        LightFieldRequest moved = request();
        moved.pose.shift = {0, 0, -depth};
        DepthMapOptions options;
        options.near = depth;
        options.far = depth + 1_mm;
        const LightFieldTile plain = rendered(prepare_scene(scene_of_picture(smooth_picture()), moved), moved),
                             flat = rendered(prepare_scene(scene_of_picture(smooth_picture(), map, options), request()),
                                             request());
        for (std::size_t i = 0; i < plain.radiance.size(); ++i)
            ASSERT_NEAR(flat.radiance.data()[i], plain.radiance.data()[i], 1e-4);
        for (std::size_t i = 0; i < plain.depth.size(); ++i) {
            const bool is_hit = std::isfinite(plain.depth.data()[i]);
            ASSERT_EQ(std::isfinite(flat.depth.data()[i]), is_hit);
            ASSERT_NEAR(is_hit ? flat.depth.data()[i] : depth, depth, 1e-8);
        }
    }
}

// In direction U, points at depth z appear at s = x − U z: the edge of the near half moves by its depth, it hides the
// far half, and what the edge uncovers continues the far half.
TEST(Pictures, have_the_parallax_of_their_depths) {
    constexpr double near = -0.8_mm, far = 1.2_mm;
    Image picture(size, size, 3);
    Array<float, 2> map({size, size});
    for (std::size_t y = 0; y < size; ++y)
        for (std::size_t x = 0; x < size; ++x) {
            picture.pixels(y, x, x < size / 2 ? 0 : 1) = 1;
            map(y, x) = x < size / 2 ? 0 : 1;
        }
    DepthMapOptions options;
    options.near = near;
    options.far = far;
    const LightFieldRequest wanted = request();
    const LightFieldTile tile = rendered(prepare_scene(scene_of_picture(picture, map, options), wanted), wanted);
    const LightFieldGrid& grid = wanted.grid;
    const double half = 0.5 * grid.width();
    std::size_t seen = 0;
    for (std::size_t u = 0; u < grid.directions_u; ++u)
        for (std::size_t s = 0; s < size; ++s) {
            const double slope = grid.u(static_cast<double>(u)), at = grid.s(static_cast<double>(s));
            const double on_near = at + slope * near, on_far = at + slope * far;
            if (std::abs(on_near) < grid.pitch || std::abs(on_near) > half - grid.pitch ||
                std::abs(on_far) > half - grid.pitch || on_far > 0.3 * half)
                continue;
            const bool is_near = on_near > 0;
            ++seen;
            ASSERT_NEAR(tile.radiance(0, size / 2, s, 1, u), is_near ? 0 : 1, 1e-4) << at << ' ' << slope;
            ASSERT_NEAR(tile.radiance(1, size / 2, s, 1, u), is_near ? 1 : 0, 1e-4) << at << ' ' << slope;
            ASSERT_NEAR(tile.depth(size / 2, s, 1, u), is_near ? near : far, 0.03_mm) << at << ' ' << slope;
        }
    EXPECT_GT(seen, 300u);
}

TEST(Pictures, fill_the_hologram) {
    LightFieldRequest wanted = request();
    wanted.front = 0.25;
    Array<float, 2> map({2, 4});
    map(0, 0) = 1;
    const Bounds plain = bounds(prepare_scene(scene_of_picture(Image(40, 20, 3)), wanted)),
                 deep = bounds(prepare_scene(scene_of_picture(Image(40, 20, 3), map), wanted));
    for (const Bounds& box : {plain, deep}) {
        EXPECT_NEAR(box.low.x, -2.4_mm, 1e-12);
        EXPECT_NEAR(box.high.x, 2.4_mm, 1e-12);
        EXPECT_NEAR(box.low.y, -1.2_mm, 1e-12);
        EXPECT_NEAR(box.high.y, 1.2_mm, 1e-12);
    }
    EXPECT_EQ(plain.low.z, 0);
    EXPECT_EQ(plain.high.z, 0);
    EXPECT_NEAR(deep.high.z, 0.25 * 1.2_mm, 1e-9);
    EXPECT_NEAR(deep.low.z, -0.75 * 1.2_mm, 1e-9);
}

}  // namespace
}  // namespace hogel::pipeline
