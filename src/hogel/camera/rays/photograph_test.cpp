// SPDX-License-Identifier: Apache-2.0
#include "hogel/photograph.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel::camera::rays {
namespace {

using namespace literals;

const LightFieldGrid coarse{80, 60, 100_um, 48, 40, Perspective{0.25, 0.22}, 1};

// The light field of a luminous plane at a depth ζ with radiance f(x, y).
LightFieldBuffer plane_at(double depth, const std::function<double(double, double)>& f,
                          const LightFieldGrid& grid = coarse) {
    LightFieldBuffer light_field(grid);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s) {
            const LightFieldGrid hogel = grid.of_hogel(double(s), double(t));
            for (std::size_t v = 0; v < grid.directions_v; ++v)
                for (std::size_t u = 0; u < grid.directions_u; ++u)
                    light_field.radiance(0, t, s, v, u) =
                        static_cast<float>(f(grid.s(double(s)) + hogel.u(double(u)) * depth,
                                             grid.t(double(t)) + hogel.v(double(v)) * depth));
        }
    return light_field;
}

Camera camera_at(Vec3 eye, double focus) {
    Camera camera;
    camera.eye = eye;
    camera.focus_depth = focus;
    camera.pupil = 4_mm;
    camera.picture = {40, 30, 150_um, 150_um, 0, 0};
    return camera;
}

// Each pixel shows the point of the luminous plane on the line of sight through the middle of the lens. The remaining
// error is the unevenness of 256 points over the pupil and the pixel.
void expect_plane(const Image& image, const Camera& camera, double depth,
                  const std::function<double(double, double)>& f) {
    const double reach = (camera.eye.z + depth) / camera.eye.z;
    for (std::size_t row = 2; row < 28; ++row)
        for (std::size_t column = 2; column < 38; ++column) {
            const double x = camera.picture.x(double(column)), y = camera.picture.y(double(row));
            const double expected =
                f(camera.eye.x + (x - camera.eye.x) * reach, camera.eye.y + (y - camera.eye.y) * reach);
            ASSERT_NEAR(image.pixels(row, column, 0), expected, 2e-3) << "pixel " << column << "," << row;
        }
}

// For a linear radiance all four interpolations and the averages over pupil and pixel are exact: each pixel shows the
// point where the line of sight through the middle of the lens meets the plane.
TEST(GeometricPhotograph, shows_a_linear_radiance_where_the_line_of_sight_meets_it) {
    const auto f = [](double x, double y) { return 1 + 100 * x - 60 * y; };
    for (double depth : {-4_mm, 0_mm, 6_mm}) {
        const LightFieldBuffer light_field = plane_at(depth, f);
        for (double focus : {-4_mm, 0_mm, 6_mm})
            for (const Vec3 eye : {Vec3{0, 0, 0.1}, Vec3{10e-3, 0, 0.1}, Vec3{-6e-3, 8e-3, 0.12}}) {
                const Camera camera = camera_at(eye, focus);
                SCOPED_TRACE(testing::Message() << "depth " << depth << ", focus " << focus << ", eye at " << eye.x);
                expect_plane(photograph(borrow(light_field), std::span(&camera, 1), {256})[0], camera, depth, f);
            }
    }
}

// The same with a fixed focal plane, in front of the hologram or behind it.
TEST(GeometricPhotograph, with_a_fixed_focal_plane_shows_a_linear_radiance_where_the_line_of_sight_meets_it) {
    const auto f = [](double x, double y) { return 1 + 100 * x - 60 * y; };
    for (const double focal : {-0.1, -0.15, 0.2})
        for (const double depth : {-4_mm, 6_mm}) {
            LightFieldGrid grid = coarse;
            grid.view = FocalPlane{{0.25, 0.22, 0.01, -0.02}, focal};
            const LightFieldBuffer light_field = plane_at(depth, f, grid);
            for (const Vec3 eye : {Vec3{0, 0, 0.1}, Vec3{10e-3, 0, 0.1}, Vec3{-6e-3, 8e-3, 0.12}}) {
                const Camera camera = camera_at(eye, depth);
                SCOPED_TRACE(testing::Message()
                             << "focal plane " << focal << ", depth " << depth << ", eye at " << eye.x);
                expect_plane(photograph(borrow(light_field), std::span(&camera, 1), {256})[0], camera, depth, f);
            }
        }
}

// A viewpoint at one of the cameras sees that camera's samples and no others.
TEST(GeometricPhotograph, from_a_point_of_the_focal_plane_shows_its_samples) {
    LightFieldGrid grid = coarse;
    grid.view = FocalPlane{{0.25, 0.22}, -0.1};
    const std::size_t k = 30, l = 11;
    LightFieldBuffer light_field(grid);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s) light_field.radiance(0, t, s, l, k) = 1;
    Camera camera = camera_at({-0.1 * grid.u(k), -0.1 * grid.v(l), 0.1}, 0);
    camera.pupil = 1e-9;
    const Image image = photograph(borrow(light_field), std::span(&camera, 1), {16})[0];
    for (const float value : image.pixels.elements()) ASSERT_NEAR(value, 1, 1e-4);
    camera.eye.x += 0.1 * grid.step_u() / 2;
    const Image between = photograph(borrow(light_field), std::span(&camera, 1), {16})[0];
    for (const float value : between.pixels.elements()) ASSERT_NEAR(value, 0.5, 1e-4);
}

// A bright stripe is sharp in focus and otherwise blurred by the circle of confusion: the mean, over the lens, of the
// stripe where the rays through one point of the plane in focus meet it.
TEST(GeometricPhotograph, blurs_by_the_circle_of_confusion) {
    const double depth = 6_mm, width = 0.4_mm;
    const auto stripe = [&](double x) { return std::exp(-x * x / (0.5 * width * width)); };
    // Sampled so finely that interpolation blurs little compared with the stripe's width.
    const LightFieldGrid fine{160, 12, 50_um, 96, 8, Perspective{0.25, 0.22}, 1};
    const LightFieldBuffer light_field = plane_at(
        depth, [&](double x, double) { return stripe(x); }, fine);
    for (double focus : {6_mm, 3_mm, 0_mm, -6_mm}) {
        Camera camera = camera_at({0, 0, 0.1}, focus);
        camera.picture = {40, 1, 60_um, 60_um, 0, 0};
        const Image image = photograph(borrow(light_field), std::span(&camera, 1), {256})[0];
        const double R = camera.eye.z, in_focus = camera.picture.x(20) * (R + focus) / R;
        double sum = 0, count = 0;
        for (double y = -1; y <= 1; y += 0.01)
            for (double x = -1; x <= 1; x += 0.01) {
                if (x * x + y * y > 1) continue;
                const double lens = 0.5 * camera.pupil * x;
                sum += stripe(lens + (in_focus - lens) * (R + depth) / (R + focus));
                ++count;
            }
        EXPECT_NEAR(image.pixels(0, 20, 0), sum / count, 0.02) << focus;
    }
}

TEST(GeometricPhotograph, is_black_outside_the_hologram_and_outside_the_field_of_view) {
    const LightFieldBuffer light_field = plane_at(0, [](double, double) { return 1; });
    Camera camera = camera_at({0, 0, 0.1}, 0);
    camera.picture = {40, 30, 250_um, 250_um, 0, 0};  // 10 mm × 7.5 mm; the hologram is 8 mm × 6 mm
    const Image image = photograph(borrow(light_field), std::span(&camera, 1))[0];
    EXPECT_EQ(image.pixels(15, 0, 0), 0);
    EXPECT_EQ(image.pixels(0, 20, 0), 0);
    EXPECT_NEAR(image.pixels(15, 20, 0), 1, 1e-5);
    EXPECT_NEAR(image.pixels(4, 5, 0), 1, 1e-5);
    camera.eye = {40_mm, 0, 100_mm};  // an angle of 0.4, where the light field ends at 0.25
    const Image from_the_side = photograph(borrow(light_field), std::span(&camera, 1))[0];
    for (float value : from_the_side.pixels.elements()) EXPECT_EQ(value, 0);
}

TEST(GeometricPhotograph, is_the_same_for_any_number_of_threads) {
    const LightFieldBuffer light_field =
        plane_at(3e-3, [](double x, double y) { return std::sin(4e3 * x) + std::cos(3e3 * y); });
    const Camera camera = camera_at({2e-3, 1e-3, 0.1}, 1e-3);
    const Image all = photograph(borrow(light_field), std::span(&camera, 1))[0];
    const ThreadLimit one(1);
    const Image alone = photograph(borrow(light_field), std::span(&camera, 1))[0];
    for (std::size_t i = 0; i < all.pixels.size(); ++i) ASSERT_EQ(all.pixels.data()[i], alone.pixels.data()[i]);
}

// The hemicube of a patterned plane close behind the hologram shows, from all sides, the point that the line of sight
// meets.
TEST(GeometricPhotograph, of_a_hemicube_shows_the_scene_to_strongly_oblique_eyes) {
    LightFieldGrid grid{40, 30, 200_um, 64, 64, Perspective{1, 1}, 1};
    const double depth = 0.4_mm;
    const auto f = [](double x, double y) { return 2 + std::sin(700 * x) + std::cos(500 * y); };
    std::vector<LightFieldBuffer> faces;
    for (const LightFieldGrid& face : hemicube(grid)) {
        LightFieldBuffer& light_field = faces.emplace_back(face);
        for (std::size_t t = 0; t < face.hogels_t; ++t)
            for (std::size_t s = 0; s < face.hogels_s; ++s)
                for (std::size_t v = 0; v < face.directions_v; ++v)
                    for (std::size_t u = 0; u < face.directions_u; ++u) {
                        const Vec3 direction = face.direction_of(face.u(double(u)), face.v(double(v)));
                        light_field.radiance(0, t, s, v, u) =
                            static_cast<float>(f(face.s(double(s)) + direction.x / direction.z * depth,
                                                 face.t(double(t)) + direction.y / direction.z * depth));
                    }
    }
    std::vector<const LightFieldSource*> sources;
    for (const LightFieldBuffer& face : faces) sources.push_back(&face);
    const double far = 0.3, distance = 0.1;
    for (const Vec3 eye :
         {Vec3{0, 0, distance}, Vec3{far, 0, distance}, Vec3{-far, 0.02, distance}, Vec3{0.01, far, distance},
          Vec3{0.02, -far, distance}, Vec3{distance, 0.01, distance}, Vec3{-far, far, distance}}) {
        Camera camera = camera_at(eye, 0);
        camera.pupil = 1_mm;
        const Image image = photograph(borrow(sources), std::span(&camera, 1))[0];
        const Image front = photograph(borrow(faces[0]), std::span(&camera, 1))[0];
        for (std::size_t row = 2; row < 28; ++row)
            for (std::size_t column = 2; column < 38; ++column) {
                const double x = camera.picture.x(double(column)), y = camera.picture.y(double(row));
                const double reach = (eye.z + depth) / eye.z;
                const double expected = f(eye.x + (x - eye.x) * reach, eye.y + (y - eye.y) * reach);
                ASSERT_NEAR(image.pixels(row, column, 0), expected, 0.03)
                    << eye.x << " " << eye.y << " pixel " << column << "," << row;
                if (std::max(std::abs(eye.x), std::abs(eye.y)) == far) {
                    ASSERT_EQ(front.pixels(row, column, 0), 0);
                }
            }
    }
}

TEST(LightField, is_made_of_faces_that_belong_together) {
    const LightFieldBuffer a(coarse);
    LightFieldGrid grid = coarse;
    grid.hogels_s /= 2;
    grid.view = Perspective{{0.5, 1, 0.5, 0}, Face::left};
    const LightFieldBuffer smaller(grid), top(hemicube({4, 4, 1e-3, 4, 4, {}, 1})[3]);
    const auto make = [](std::vector<const LightFieldSource*> faces) { return borrow(faces); };
    EXPECT_EQ(make({&a}).faces().size(), 1u);
    EXPECT_THROW(make({}), Error);              // no front
    EXPECT_THROW(make({&top}), Error);          // no front
    EXPECT_THROW(make({&a, &a}), Error);        // a face twice
    EXPECT_THROW(make({&a, &smaller}), Error);  // other hogels
}

}  // namespace
}  // namespace hogel::camera::rays
