// SPDX-License-Identifier: Apache-2.0
#include "hogel/bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>

#include "hogel/core/random.h"
#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::patterns {
namespace {

using namespace literals;

constexpr double bench_pitch = 8_um, bench_wavelength = 532_nm;

Field panel_with(std::size_t side_of_panel, const std::function<std::complex<float>(std::size_t, std::size_t)>& value) {
    Field field(FieldGrid{{side_of_panel, side_of_panel, bench_pitch, bench_pitch, 0, 0}, bench_wavelength});
    for (std::size_t y = 0; y < side_of_panel; ++y)
        for (std::size_t x = 0; x < side_of_panel; ++x) field.samples(y, x) = value(y, x);
    return field;
}

// Phases that are independent in all pixels.
Field random_phases(std::size_t side_of_panel) {
    return panel_with(side_of_panel, [](std::size_t y, std::size_t x) {
        const auto bits = core::philox({std::uint32_t(x), std::uint32_t(y), 0, 0}, {3, 0})[0];
        return std::complex<float>(std::polar(1.0, 2 * std::numbers::pi * (bits / 4294967296.0)));
    });
}

Bench laser_bench(double radius, double focus = 0) {
    Bench bench{.focal_length = 200_mm, .aperture = {0, 0, radius}};
    bench.focus = focus;
    return bench;
}

double middle_mean(const Image& picture) {
    double sum = 0, count = 0;
    for (std::size_t y = picture.height() / 4; y < 3 * picture.height() / 4; ++y)
        for (std::size_t x = picture.width() / 4; x < 3 * picture.width() / 4; ++x) {
            sum += double(picture.pixels(y, x, 0));
            ++count;
        }
    return sum / count;
}

TEST(OpticalBench, a_mirror_has_the_intensity_1_behind_any_aperture) {
    const Field mirror = panel_with(128, [](std::size_t, std::size_t) { return 1.0F; });
    for (const double fill : {1.0, 0.7}) {
        Bench bench = laser_bench(0.2);
        bench.fill_factor = fill;
        const BenchPhotograph photograph = photograph_on_bench(mirror, bench);
        EXPECT_NEAR(middle_mean(photograph.picture), 1, 0.02);
        EXPECT_NEAR(photograph.efficiency, 1, 0.03);
        EXPECT_NEAR(photograph.resolution, 0.61 * bench_pitch / 0.2, 1e-9);
    }
}

// A pattern with neighbouring pixels of opposite phase has no light in the zero order, so that the rest comes from the
// gap: an amplitude of 1 − F.
TEST(OpticalBench, the_gap_makes_the_zero_order) {
    const Field checkered =
        panel_with(192, [](std::size_t y, std::size_t x) { return (x + y) % 2 == 0 ? 1.0F : -1.0F; });
    for (const double fill : {0.9, 0.6, 0.3}) {
        Bench bench = laser_bench(0.1);
        bench.fill_factor = fill;
        const BenchPhotograph photograph = photograph_on_bench(checkered, bench);
        EXPECT_NEAR(middle_mean(photograph.picture) / std::pow(1 - fill, 2), 1, 0.03) << fill;
        bench.zero_order_stop = 0.05;
        EXPECT_LT(middle_mean(photograph_on_bench(checkered, bench).picture), 0.01 * std::pow(1 - fill, 2)) << fill;
    }
}

TEST(OpticalBench, incoherent_points_average_speckle) {
    const Field diffuser = random_phases(512);
    for (const std::size_t points : {1, 4, 16}) {
        Bench bench = laser_bench(0.25, 20_mm);
        bench.source = {LightSource::Kind::points, 4_mm, points};  // neighbours move the light by 12 cells or more
        const double contrast = photograph_on_bench(diffuser, bench).contrast;
        EXPECT_NEAR(contrast * std::sqrt(double(points)), 1, 0.05) << points;
    }
}

// A lens in the pattern focuses the light of each point of the source at the depth.
TEST(OpticalBench, a_source_blurs_by_its_angle) {
    const double depth = 30_mm, focal = 200_mm, size = 5_mm;
    const std::size_t side_of_panel = 256;
    const Field lens = panel_with(side_of_panel, [&](std::size_t y, std::size_t x) {
        const double centre = 0.5 * (double(side_of_panel) - 1);
        const double r = bench_pitch * std::hypot(double(x) - centre, double(y) - centre);
        return std::complex<float>(std::polar(1.0, std::numbers::pi * r * r / (bench_wavelength * depth)));
    });
    const auto width =
        [&](double source_size) {  // of an evenly bright disc with the same mean square, of the brighter pixels
            Bench bench = laser_bench(0.4, depth);
            bench.focal_length = focal;
            bench.source = {LightSource::Kind::points, source_size, 100};
            const Image picture = photograph_on_bench(lens, bench).picture;
            double sum = 0, squares = 0, brightest = 0;
            for (const float value : picture.pixels.elements()) brightest = std::max(brightest, double(value));
            for (std::size_t y = 0; y < side_of_panel; ++y)
                for (std::size_t x = 0; x < side_of_panel; ++x) {
                    if (double(picture.pixels(y, x, 0)) < 0.1 * brightest) continue;
                    const double centre = 0.5 * (double(side_of_panel) - 1);
                    const double light = double(picture.pixels(y, x, 0));
                    sum += light;
                    squares += light * (std::pow(double(x) - centre, 2) + std::pow(double(y) - centre, 2));
                }
            return 2 * std::sqrt(2 * squares / sum) * bench_pitch;
        };
    EXPECT_NEAR(width(size), depth * size / focal, bench_pitch);
    EXPECT_LT(width(0), 2.5 * bench_pitch);
}

TEST(OpticalBench, a_led_converges) {
    const Field diffuser = random_phases(128);
    Bench bench = laser_bench(0.2, 2_mm);
    bench.source = {LightSource::Kind::led, 2_mm, 1, bench_wavelength, 20_nm};
    const BenchPhotograph led = photograph_on_bench(diffuser, bench);
    EXPECT_TRUE(led.is_converged);
    EXPECT_GT(led.points, 1U);
    EXPECT_GE(led.wavelengths, 5U);
    bench.source.size = 50_mm;
    bench.focus = 100_mm;
    EXPECT_FALSE(photograph_on_bench(random_phases(32), bench).is_converged);
}

TEST(OpticalBench, errors_name_the_parameter) {
    const Field mirror = panel_with(16, [](std::size_t, std::size_t) { return 1.0F; });
    const auto refused = [&](const std::function<void(Bench&)>& change) {
        Bench bench = laser_bench(0.2);
        change(bench);
        try {
            photograph_on_bench(mirror, bench);
        } catch (const Error& error) {
            return error.parameter();
        }
        return std::string("none");
    };
    EXPECT_EQ(refused([](Bench&) {}), "none");
    EXPECT_EQ(refused([](Bench& bench) { bench.focal_length = 0; }), "focal");
    EXPECT_EQ(refused([](Bench& bench) { bench.aperture.radius = 0.6; }), "aperture");
    EXPECT_EQ(refused([](Bench& bench) { bench.aperture.x = 0.6; }), "order");
    EXPECT_EQ(refused([](Bench& bench) { bench.fill_factor = 0; }), "fill_factor");
    EXPECT_EQ(refused([](Bench& bench) { bench.zero_order_stop = -1; }), "zero_order_stop");
    EXPECT_EQ(refused([](Bench& bench) { bench.focus = 100; }), "focus");
    EXPECT_EQ(refused([](Bench& bench) { bench.source.size = -1; }), "source");
    EXPECT_EQ(refused([](Bench& bench) { bench.source = {LightSource::Kind::points, 1_mm, 5000}; }), "source");
}

TEST(OpticalBench, the_text_of_an_aperture_reads_back) {
    for (const Aperture& aperture : {Aperture{0, 0, 0.125}, Aperture{-0.25, 0.0625, 0.1}}) {
        const auto read = parse_aperture(describe(aperture, 0.07));
        ASSERT_TRUE(read.has_value());
        EXPECT_EQ(read->x, aperture.x);
        EXPECT_EQ(read->y, aperture.y);
        EXPECT_EQ(read->radius, aperture.radius);
    }
    EXPECT_FALSE(parse_aperture("radius 1 m").has_value());
}

}  // namespace
}  // namespace hogel::patterns
