// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "hogel/error.h"
#include "hogel/photograph.h"
#include "hogel/units.h"

namespace hogel::stereogram {
namespace {

using namespace literals;

// The spot in a picture: its centroid, and the full width at half maximum of its horizontal profile through the
// brightest pixel, in metres on the hologram plane.
struct Spot {
    double x = 0, y = 0, width = 0, peak = 0;
};

Spot measure(const Image& image, const Grid& picture) {
    Spot spot;
    std::size_t peak_row = 0, peak_column = 0;
    for (std::size_t row = 0; row < image.height(); ++row)
        for (std::size_t column = 0; column < image.width(); ++column)
            if (image.pixels(row, column, 0) > spot.peak) {
                spot.peak = image.pixels(row, column, 0);
                peak_row = row;
                peak_column = column;
            }
    double sum = 0;
    for (std::size_t row = 0; row < image.height(); ++row)
        for (std::size_t column = 0; column < image.width(); ++column) {
            const double value = image.pixels(row, column, 0);
            // Only the core of the spot determines its position, because its rings extend without limit.
            if (value < 0.3 * spot.peak) continue;
            sum += value;
            spot.x += value * picture.x(double(column));
            spot.y += value * picture.y(double(row));
        }
    spot.x /= sum;
    spot.y /= sum;
    const auto crossing = [&](int direction) {
        double column = double(peak_column), before = spot.peak;
        for (std::size_t at = peak_column; at > 0 && at + 1 < image.width();) {
            at = direction > 0 ? at + 1 : at - 1;
            const double value = image.pixels(peak_row, at, 0);
            if (value < 0.5 * spot.peak) return column + direction * (before - 0.5 * spot.peak) / (before - value);
            before = value;
            column = double(at);
        }
        return column;
    };
    spot.width = (crossing(1) - crossing(-1)) * picture.pitch_x;
    return spot;
}

struct Case {
    double depth;  // ζ
    Vec3 eye;
};

class PointPhotograph : public ::testing::TestWithParam<Case> {
  protected:
    const double wavelength = 633_nm;
    const FieldGrid grid{{2048, 2048, 2_um, 2_um, 0, 0}, wavelength};
    Camera camera_at(Vec3 eye, double focus, double x, double y) const {
        Camera camera;
        camera.eye = eye;
        camera.focus_depth = focus;
        camera.pupil = 4_mm;
        camera.picture = {96, 96, 3_um, 3_um, x, y};
        return camera;
    }
};

// A point appears at its geometric position, as narrow as diffraction allows, and sharpest with the focus at its depth.
TEST_P(PointPhotograph, lies_where_geometry_says_and_is_diffraction_limited) {
    const auto [depth, eye] = GetParam();
    const Vec3 point{0.2e-3, -0.3e-3, -depth};
    const Field field = point_hologram(std::span<const PointSource>(std::array{PointSource{point, 1, 0}}), grid);
    // Seen from the middle of the lens, the point is in line with this point of the hologram plane.
    const double along = eye.z / (eye.z - point.z);
    const double x = eye.x + along * (point.x - eye.x), y = eye.y + along * (point.y - eye.y);
    const std::array cameras{camera_at(eye, depth, x, y), camera_at(eye, depth + 2_mm, x, y),
                             camera_at(eye, depth - 2_mm, x, y)};
    const std::vector<Image> images = photograph(field, cameras);
    const Spot sharp = measure(images[0], cameras[0].picture);
    const double cell = resolution_cell(cameras[0], wavelength);
    EXPECT_NEAR(sharp.x, x, 0.1 * cell);
    EXPECT_NEAR(sharp.y, y, 0.1 * cell);
    // Full width at half maximum of the Airy pattern: 1.029 λR/A, for the distance and obliquity of the viewpoint.
    const Vec3 seen{x, y, 0};
    const double distance = length(eye - seen), cosine = eye.z / distance, sine = (eye.x - x) / distance;
    const double expected = 1.029 * wavelength * distance / 4_mm / (1 - sine * sine);
    EXPECT_GT(cosine, 0.9);
    EXPECT_NEAR(sharp.width / expected, 1, 0.1);
    EXPECT_GT(sharp.peak, 1.5 * measure(images[1], cameras[1].picture).peak);
    EXPECT_GT(sharp.peak, 1.5 * measure(images[2], cameras[2].picture).peak);
}

INSTANTIATE_TEST_SUITE_P(DepthsAndEyes, PointPhotograph,
                         ::testing::Values(Case{5e-3, {0, 0, 0.1}}, Case{5e-3, {20e-3, 0, 0.1}},
                                           Case{5e-3, {-10e-3, 15e-3, 0.1}}, Case{-5e-3, {0, 0, 0.1}},
                                           Case{-5e-3, {20e-3, 0, 0.1}}, Case{-5e-3, {-10e-3, 15e-3, 0.1}},
                                           Case{12e-3, {0, 0, 0.12}}));

TEST(PointHologram, is_the_spherical_wave_of_its_point_and_refuses_the_plane_itself) {
    const FieldGrid grid{{3, 2, 5_um, 5_um, 0, 0}, 532_nm};
    const PointSource point{{1e-3, 2e-3, -4e-3}, 0.3, 0.7};
    const Field field = point_hologram(std::span(&point, 1), grid);
    const double r = std::hypot(1e-3 - grid.plane.x(2), 2e-3 - grid.plane.y(1), 4e-3);
    const auto expected =
        std::polar(0.3 / r, std::remainder(2 * std::numbers::pi * (r / 532e-9) + 0.7, 2 * std::numbers::pi));
    EXPECT_LT(std::abs(std::complex<double>(field.samples(1, 2)) - expected), 1e-4 * std::abs(expected));
    const PointSource on_plane{{0, 0, 0}};
    EXPECT_THROW(point_hologram(std::span(&on_plane, 1), grid), Error);
}

}  // namespace
}  // namespace hogel::stereogram
