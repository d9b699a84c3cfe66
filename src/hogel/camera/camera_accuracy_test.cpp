// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "hogel/optics/pupil_edge.h"
#include "hogel/photograph.h"
#include "hogel/units.h"

namespace hogel::camera {
namespace {

using namespace literals;

struct Alike {
    double brightness, correlation, psnr;
};

Alike alike_to(const Image& test, const Image& truth) {
    double a = 0, b = 0, aa = 0, ab = 0, bb = 0, error = 0, peak = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const double x = test.pixels.data()[i], y = truth.pixels.data()[i];
        a += x, b += y, aa += x * x, ab += x * y, bb += y * y, error += (x - y) * (x - y);
        peak = std::max(peak, y);
    }
    const auto n = static_cast<double>(truth.pixels.size());
    return {a / b, (ab - a * b / n) / std::sqrt((aa - a * a / n) * (bb - b * b / n)),
            10 * std::log10(peak * peak * n / error)};
}

Field random_field(const FieldGrid& grid, unsigned seed) {
    Field field(grid);
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    for (auto& value : field.samples.elements()) value = {normal(random), normal(random)};
    return field;
}

struct Look {
    double degrees, focus;
};

class AccurateCameras : public ::testing::TestWithParam<Look> {};

// A hologram of 13 resolution cells is small enough for the direct sum; a tenth of the light of its points falls beside
// it.
TEST_P(AccurateCameras, are_as_bright_as_the_direct_sum) {
    const FieldGrid grid{{100, 96, 0.45_um, 0.45_um, 0, 0}, 532_nm};
    const Field field = random_field(grid, 4);
    const double angle = GetParam().degrees * std::numbers::pi / 180;
    Camera camera;
    camera.eye = {10e-3 * std::tan(angle), 0, 10_mm};
    camera.pupil = 1.6_mm;
    camera.focus_depth = GetParam().focus;
    camera.picture = {15, 14, 2.9_um, 2.9_um, 0, 0};
    const Image direct = photograph(field, {&camera, 1}, DirectCamera{48, 4}).front();
    for (const bool narrow : {true, false}) {
        const Image picture = narrow ? photograph(field, std::span(&camera, 1))[0]
                                     : photograph(field, std::span(&camera, 1), PlaneWaveCamera())[0];
        const Alike alike = alike_to(picture, direct);
        EXPECT_NEAR(alike.brightness, 1, 2e-3) << narrow;
        EXPECT_GT(alike.correlation, 0.9999) << narrow;
        EXPECT_GT(alike.psnr, 58) << narrow;
    }
}

INSTANTIATE_TEST_SUITE_P(AnglesAndFocuses, AccurateCameras,
                         ::testing::Values(Look{0, 0}, Look{0, 0.1e-3}, Look{0, -0.1e-3}, Look{15, 0}, Look{15, 0.1e-3},
                                           Look{15, -0.1e-3}, Look{30, 0}, Look{30, 0.1e-3}, Look{30, -0.1e-3}));

// Parts of a picture within the outline of the hologram, and beside it.
struct Parts {
    Image inside, beside;
};

Parts parted(const Image& picture, const Camera& camera, const FieldGrid& hologram) {
    Parts parts{picture, picture};
    const Rectangle outline(hologram.plane);
    for (std::size_t row = 0; row < picture.height(); ++row)
        for (std::size_t column = 0; column < picture.width(); ++column) {
            const bool inside = outline.holds(camera.picture.x(double(column)), camera.picture.y(double(row)));
            (inside ? parts.beside : parts.inside).pixels(row, column, 0) = 0;
        }
    return parts;
}

double sum(const Image& image) {
    double all = 0;
    for (const float value : image.pixels.elements()) all += value;
    return all;
}

class CamerasAtTheOutline : public ::testing::TestWithParam<Look> {};

// A picture twice as wide as the hologram shows its diffraction beside it, and its blur where it is out of focus.
TEST_P(CamerasAtTheOutline, show_the_surroundings_as_the_direct_sum_does) {
    const FieldGrid grid{{60, 56, 0.75_um, 0.75_um, 0, 0}, 532_nm};
    const Field field = random_field(grid, 4);
    Camera camera;
    camera.eye = {10e-3 * std::tan(GetParam().degrees * std::numbers::pi / 180), 0, 10_mm};
    camera.pupil = 1.6_mm;
    camera.focus_depth = GetParam().focus;
    camera.picture = {22, 20, 4_um, 4_um, 3_um, -2_um};
    const Parts direct = parted(photograph(field, {&camera, 1}, DirectCamera{48, 3}).front(), camera, grid);
    for (const bool narrow : {true, false}) {
        const Image picture = narrow ? photograph(field, std::span(&camera, 1))[0]
                                     : photograph(field, std::span(&camera, 1), PlaneWaveCamera())[0];
        const Parts parts = parted(picture, camera, grid);
        EXPECT_NEAR(sum(parts.beside) / sum(direct.beside), 1, 0.01) << narrow;
        EXPECT_NEAR(sum(parts.inside) / sum(direct.inside), 1, 2e-3) << narrow;
        EXPECT_GT(alike_to(parts.beside, direct.beside).psnr, 50) << narrow;
        EXPECT_GT(alike_to(parts.inside, direct.inside).psnr, 55) << narrow;
    }
}

INSTANTIATE_TEST_SUITE_P(AnglesAndFocuses, CamerasAtTheOutline,
                         ::testing::Values(Look{0, 0}, Look{0, 0.15e-3}, Look{15, -0.15e-3}));

// Most of the light of a point that floats before the edge of a hologram is beside the outline.
TEST(CamerasAtTheOutline, show_a_point_before_the_edge) {
    const FieldGrid grid{{60, 56, 0.75_um, 0.75_um, 0, 0}, 532_nm};
    Field field(grid);
    const Vec3 point{24_um, 2_um, 0.2_mm};
    for (std::size_t row = 0; row < grid.plane.height; ++row)
        for (std::size_t column = 0; column < grid.plane.width; ++column) {
            const double r = length(Vec3{grid.plane.x(double(column)), grid.plane.y(double(row)), 0} - point);
            field.samples(row, column) =
                std::complex<float>(std::polar(1e-4 / r, -2 * std::numbers::pi * r / grid.wavelength));
        }
    Camera camera;
    camera.eye = {0, 0, 10_mm};
    camera.pupil = 1.6_mm;
    camera.focus_depth = -point.z;
    camera.picture = {22, 20, 4_um, 4_um, 3_um, -2_um};
    const auto share_beside = [&](const Image& picture) {
        return sum(parted(picture, camera, grid).beside) / sum(picture);
    };
    const double direct = share_beside(photograph(field, {&camera, 1}, DirectCamera{48, 3}).front());
    EXPECT_GT(direct, 0.5);
    EXPECT_NEAR(share_beside(photograph(field, std::span(&camera, 1))[0]), direct, 2e-3);
    EXPECT_NEAR(share_beside(photograph(field, std::span(&camera, 1), PlaneWaveCamera())[0]), direct, 2e-3);
}

// Blurs of 344 and 172 resolution cells, 43 cycles of defocus at the rim of the pupil and half as many: light is
// followed beyond the PSF.
TEST(NarrowAndFullCamera, equal_the_direct_sum_far_out_of_focus) {
    const FieldGrid grid{{16, 14, 1.5_um, 1.5_um, 0, 0}, 633_nm};
    const Field field = random_field(grid, 6);
    for (const double focus : {-4.5e-3, -3e-3}) {
        Camera camera;
        camera.eye = {0, 0, 9_mm};
        camera.pupil = 1.4_mm;
        camera.focus_depth = focus;
        camera.picture = {5, 4, 4.8_um, 4.8_um, 0, 0};
        const Image direct = photograph(field, {&camera, 1}, DirectCamera{400, 3}).front();
        for (const bool narrow : {true, false}) {
            const Image picture = narrow ? photograph(field, std::span(&camera, 1))[0]
                                         : photograph(field, std::span(&camera, 1), PlaneWaveCamera())[0];
            const Alike alike = alike_to(picture, direct);
            EXPECT_NEAR(alike.brightness, 1, narrow ? 3e-3 : 1e-3) << narrow << " " << focus;
            EXPECT_GT(alike.psnr, narrow ? 40 : 50) << focus;
        }
    }
}

// Pictures with neighbouring focuses are blended there.
TEST(NarrowCamera, equals_the_direct_sum_on_tilted_planes) {
    const FieldGrid grid{{60, 56, 0.9_um, 0.9_um, 0, 0}, 532_nm};
    const Field field = random_field(grid, 5);
    for (const double degrees : {15.0, 60.0}) {
        Camera camera;
        camera.eye = {1_mm, 0, 10_mm};
        camera.pupil = 1.6_mm;
        camera.focus_slope_x = std::tan(degrees * std::numbers::pi / 180);
        camera.focus_slope_y = -0.5 * camera.focus_slope_x;
        camera.picture = {16, 15, 3.4_um, 3.4_um, 0, 0};
        const Alike alike = alike_to(photograph(field, std::span(&camera, 1))[0],
                                     photograph(field, {&camera, 1}, DirectCamera{56, 4}).front());
        EXPECT_GT(alike.psnr, 58) << degrees;
        EXPECT_NEAR(alike.brightness, 1, 2e-3) << degrees;
    }
}

// Two cameras that share no step but the interpolation of intensities.
TEST(NarrowAndFullCamera, show_the_same_speckle) {
    const FieldGrid grid{{400, 360, 0.8_um, 0.8_um, 20_um, 0}, 532_nm};
    const Field field = random_field(grid, 11);
    for (const Vec3 eye : {Vec3{0, 0, 30_mm}, Vec3{8_mm, -4_mm, 30_mm}}) {
        Camera camera;
        camera.eye = eye;
        camera.pupil = 3_mm;
        camera.picture = {80, 72, 4_um, 4_um, 20_um, 0};
        const Alike alike = alike_to(photograph(field, std::span(&camera, 1))[0],
                                     photograph(field, std::span(&camera, 1), PlaneWaveCamera())[0]);
        EXPECT_GT(alike.psnr, 55) << eye.x;
        EXPECT_GT(alike.correlation, 0.9999) << eye.x;
        EXPECT_NEAR(alike.brightness, 1, 2e-3) << eye.x;
    }
}

// A pupil's own light, the mean of 1 − J₀² − J₁² within m cells, and its share beyond.
TEST(SpreadWindow, leaves_out_what_airys_disc_has_beyond_it) {
    const double cell = 1e-4;
    const optics::SpreadWindow window(0.5, 0.5, 0, cell);
    EXPECT_EQ(window.flat, 128 * cell);
    const double m = 0.5 * (window.flat + window.stop) / cell, x = 3.141592653589793 * m;
    const double beyond = std::pow(std::cyl_bessel_j(0.0, x), 2) + std::pow(std::cyl_bessel_j(1.0, x), 2);
    const double hologram = 2 / (9.869604401089358 * 0.25 / cell);
    EXPECT_NEAR(optics::light_left_out(window, 0.5, 0.5, cell), beyond - hologram, 2e-5);
    // A point out of focus falls off from the rim of its PSF, which may be wider than that.
    const optics::SpreadWindow blurred(0.5, 0.5, 600 * cell, cell);
    EXPECT_EQ(blurred.flat, (300 + 128) * cell);
    EXPECT_NEAR(optics::light_left_out(blurred, 0.5, 0.5, cell), optics::light_left_out(window, 0.5, 0.5, cell), 1e-9);
    EXPECT_EQ(optics::light_left_out(optics::SpreadWindow(5 * cell, 5 * cell, 0, cell), 5 * cell, 5 * cell, cell), 0);
}

// The transform of a slit with two soft rims is that of a slit times the window: unchanged up to `flat`, nothing from
// `stop` on.
TEST(PupilEdge, limits_the_spread_of_a_slit) {
    const double wavelength = 500e-9, half = 1e-3, step = 1e-6;
    optics::SpreadWindow window(0.01, 0.01, 0.002, wavelength / (2 * half));
    const optics::PupilEdge edge(window, wavelength);
    EXPECT_EQ(edge.transmission(-edge.reach()), 0);
    EXPECT_EQ(edge.transmission(edge.reach()), 1);
    const auto spread = [&](double sine) {
        double sum = 0;
        for (double x = -2 * half; x < 2 * half; x += step)
            sum += edge.transmission(half - std::abs(x)) * std::cos(6.283185307179586 * sine * x / wavelength) * step;
        return sum;
    };
    const auto slit = [&](double sine) {
        const double turn = 6.283185307179586 * sine / wavelength;
        return std::sin(turn * half) / (0.5 * turn);
    };
    for (double part : {0.1, 0.5, 0.9, 0.99}) {
        const double sine = part * window.flat;
        EXPECT_NEAR(spread(sine), slit(sine), 4e-3 * std::abs(1 / (3.14159 * sine / wavelength))) << part;
    }
    for (double part : {1.01, 1.3, 2.0}) {
        const double sine = part * window.stop;
        EXPECT_NEAR(spread(sine), 0, 4e-3 * std::abs(1 / (3.14159 * sine / wavelength))) << part;
    }
}

}  // namespace
}  // namespace hogel::camera
