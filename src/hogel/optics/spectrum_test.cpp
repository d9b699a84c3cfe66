// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/spectrum.h"

#include "hogel/propagate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "hogel/error.h"
#include "hogel/optics/elements.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/optics/tilt.h"
#include "hogel/units.h"

namespace hogel::optics {
namespace {

using namespace literals;
using Complex = std::complex<double>;
using std::numbers::pi;

const double wavelength = 633_nm;

template <class Value>
Field sampled(const Grid& plane, const Value& value) {
    Field field({plane, wavelength});
    for (std::size_t row = 0; row < plane.height; ++row)
        for (std::size_t column = 0; column < plane.width; ++column)
            field.samples(row, column) = std::complex<float>(value(plane.x(double(column)), plane.y(double(row))));
    return field;
}

// Returns the largest difference from a closed form over the samples selected by `where`.
template <class Source, class Value, class Where>
double worst(const Source& field, const Value& value, const Where& where) {
    const Grid& plane = field.grid().plane;
    Array<std::complex<float>, 2> samples({plane.height, plane.width});
    field.read({0, 0, plane.width, plane.height}, 0, samples);
    double max_error = 0;
    for (std::size_t row = 0; row < plane.height; ++row)
        for (std::size_t column = 0; column < plane.width; ++column) {
            const double x = plane.x(double(column)), y = plane.y(double(row));
            if (where(x, y)) max_error = std::max(max_error, std::abs(Complex(samples(row, column)) - value(x, y)));
        }
    return max_error;
}
template <class Source, class Value>
double worst(const Source& field, const Value& value) {
    return worst(field, value, [](double, double) { return true; });
}

// A Gaussian beam along z of waist w at (x0, y0, 0), at a point; paraxial, which is exact to (λ/πw)².
Complex gaussian_beam(double w, double x, double y, double z) {
    const double range = pi * w * w / wavelength, square = x * x + y * y;
    const Complex q = Complex(1, z / range);
    return std::exp(-square / (w * w) / q) / q * unit_phasor(z / wavelength);
}

Field noise(const Grid& plane) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    return sampled(plane, [&](double, double) { return Complex(normal(random), normal(random)); });
}

double energy(const Spectrum& spectrum) {
    double sum = 0;
    for (const auto& value : spectrum.samples.view().elements()) sum += std::norm(Complex(value));
    return sum;
}

TEST(Spectrum, a_tilted_plane_wave_gains_its_phase) {
    const Grid plane{100, 90, 1_um, 1.5_um, 0.3_mm, -0.1_mm};
    const double fx = 17 / plane.size_x(), fy = -9 / plane.size_y(), z = 0.7_mm;
    const double fz = std::sqrt(1 / (wavelength * wavelength) - fx * fx - fy * fy);
    const auto wave = [&](double x, double y) { return unit_phasor(fx * x + fy * y); };
    Spectrum spectrum = spectrum_of(sampled(plane, wave), 0, plane, Band::of(plane));
    EXPECT_NEAR(
        std::abs(spectrum.samples.view()(std::size_t(9 - spectrum.first_row), std::size_t(17 - spectrum.first_column))),
        plane.size_x() * plane.size_y(), 1e-5 * plane.size_x() * plane.size_y());
    propagate(spectrum, {z, 0, 0, 1, 1});
    const Wave propagated = wave_of(spectrum, 100, 90);
    EXPECT_LT(worst(propagated, [&](double x, double y) { return wave(x, y) * unit_phasor(fz * z); }), 1e-5);
}

TEST(Spectrum, a_gaussian_beam_widens_and_curves) {
    const Grid plane{512, 480, 1_um, 1_um, 0, 0};
    const Field waist = sampled(plane, [](double x, double y) { return gaussian_beam(20_um, x, y, 0); });
    for (double z : {3_mm, -5_mm}) {
        const Field propagated = hogel::propagate(waist, z);
        EXPECT_LT(worst(propagated, [&](double x, double y) { return gaussian_beam(20_um, x, y, z); }), 1e-3) << z;
    }
}

// The spherical wave e^{ikr}/r of a point at the complex position z = ib is an exact, not a paraxial, solution of the
// wave equation: a beam with wide tails.
TEST(Spectrum, a_spherical_wave_stays_spherical) {
    const Grid plane{600, 560, 0.4_um, 0.4_um, 0, 0};
    const double b = 12_um, k = 2 * pi / wavelength;
    const auto wave = [&](double x, double y, double z) {
        Complex r = std::sqrt(x * x + y * y + Complex(z, -b) * Complex(z, -b));
        if (r.real() < 0) r = -r;
        return 100_um / r * std::exp(Complex(0, k) * r - k * b);
    };
    const Field before = sampled(plane, [&](double x, double y) { return wave(x, y, 100_um); });
    for (double z : {200_um, -60_um, 350_um}) {
        const Field propagated = hogel::propagate(before, z);
        EXPECT_LT(worst(propagated, [&](double x, double y) { return wave(x, y, 100_um + z); }), 1e-3) << z;
    }
}

// Two steps equal one step, backward propagation restores the original, and the energy is conserved, for all
// propagating frequencies of the samples.
TEST(Spectrum, distances_add_and_energy_stays) {
    const Grid plane{240, 200, 0.8_um, 0.8_um, 0, 0};
    const Field field = noise(plane);
    const auto start = [&] { return spectrum_of(field, 0, plane, Band::of(plane)); };
    const auto difference = [](const Spectrum& a, const Spectrum& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.samples.view().size(); ++i)
            sum += std::norm(Complex(a.samples.view().data()[i]) - Complex(b.samples.view().data()[i]));
        return std::sqrt(sum / energy(a));
    };
    const Spectrum before = start();
    Spectrum there_and_back = start(), in_two = start(), in_one = start();
    propagate(there_and_back, {2_mm, 0, 0, 1, 1});
    EXPECT_NEAR(energy(there_and_back) / energy(before), 1, 1e-6);
    propagate(there_and_back, {-2_mm, 0, 0, 1, 1});
    EXPECT_LT(difference(before, there_and_back), 1e-6);
    propagate(in_two, {0.5_mm, 10_um, 0, 1, 1});
    propagate(in_two, {1.1_mm, -4_um, 7_um, 1, 1});
    propagate(in_one, {1.6_mm, 6_um, 7_um, 1, 1});
    EXPECT_LT(difference(in_one, in_two), 1e-3);
    EXPECT_NEAR(in_two.window.center_x, 6e-6, 1e-12);
    const Wave same = wave_of(before, plane.width, plane.height);
    EXPECT_LT(worst(same,
                    [&](double x, double y) {
                        return Complex(field.samples(std::size_t(std::lround(plane.row(y))),
                                                     std::size_t(std::lround(plane.column(x)))));
                    }),
              1e-5);
}

// A converging spherical wave through a round opening gives Airy's pattern with a peak of πa²/λR.
TEST(Elements, a_round_lens_makes_airys_pattern) {
    const Grid plane{700, 700, 1_um, 1_um, 0, 0};
    const double radius = 0.25_mm, focal = 15_mm;
    Wave wave({plane, wavelength}, {});
    for (auto& value : wave.samples.view().elements()) value = 1;
    thin_lens(wave, 0, 0, 2 * radius, focal);
    const Field focus = hogel::propagate(wave, focal);
    const auto airy = [&](double x, double y) {
        const double v = 2 * pi * radius * std::hypot(x, y) / (wavelength * focal);
        return v < 1e-9 ? 1.0 : 2 * std::cyl_bessel_j(1.0, v) / v;
    };
    const double peak = pi * radius * radius / (wavelength * focal);
    EXPECT_LT(worst(
                  focus,
                  [&](double x, double y) {
                      const double along = focal + (x * x + y * y) / (2 * focal);
                      return Complex(0, -peak) * airy(x, y) * unit_phasor(along / wavelength);
                  },
                  [](double x, double y) { return std::hypot(x, y) < 0.15_mm; }),
              1e-3 * peak);
}

// ∫ e^{iπt²/2} dt from 0 to u, by Simpson's rule.
Complex fresnel_integral(double u) {
    const int n = 2000;
    Complex sum = 0;
    for (int i = 0; i <= n; ++i) {
        const double t = u * i / n;
        sum += (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * std::polar(1.0, 0.5 * pi * t * t);
    }
    return sum * (u / n / 3);
}

TEST(Elements, a_rectangular_opening_makes_fresnels_pattern) {
    const Grid plane{900, 800, 0.5_um, 0.5_um, 0, 0};
    Wave wave({plane, wavelength}, {});
    for (auto& value : wave.samples.view().elements()) value = 1;
    const Rectangle opening{Grid{200, 160, 1_um, 1_um, 0, 0}};
    rectangular_aperture(wave, opening);
    const double z = 30_mm, scale = std::sqrt(2 / (wavelength * z));
    const Field propagated = hogel::propagate(wave, z);
    const auto along = [&](double at, double half) {
        return (fresnel_integral(scale * (half - at)) + fresnel_integral(scale * (half + at))) *
               std::polar(std::sqrt(0.5), -pi / 4);
    };
    std::vector<Complex> columns(plane.width), rows(plane.height);
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = along(plane.x(double(i)), 100_um);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = along(plane.y(double(i)), 80_um);
    EXPECT_LT(worst(
                  propagated,
                  [&](double x, double y) {
                      return columns[std::size_t(std::lround(plane.column(x)))] *
                             rows[std::size_t(std::lround(plane.row(y)))] * unit_phasor(z / wavelength);
                  },
                  [](double x, double y) { return std::abs(x) < 200_um && std::abs(y) < 160_um; }),
              1e-3);
}

TEST(Elements, a_grating_diffracts_into_its_orders) {
    const Grid plane{400, 32, 1_um, 1_um, 0, 0};
    const double period = 20_um, z = 1.7_mm;
    const Field grating =
        sampled(plane, [&](double x, double) { return Complex(0.5 + 0.5 * std::cos(2 * pi * x / period)); });
    Spectrum spectrum = spectrum_of(grating, 0, plane, Band::of(plane));
    double outside = 0;
    for (std::size_t row = 0; row < spectrum.height(); ++row)
        for (std::size_t column = 0; column < spectrum.width(); ++column) {
            const double fx = spectrum.frequency_x(double(column)), fy = spectrum.frequency_y(double(row));
            const double share = std::abs(spectrum.samples.view()(row, column)) / (plane.size_x() * plane.size_y());
            const double order = std::abs(fx) * period;
            const double expected = std::abs(fy) > 1e-6          ? 0
                                    : order < 1e-6               ? 0.5
                                    : std::abs(order - 1) < 1e-6 ? 0.25
                                                                 : 0;
            outside = std::max(outside, std::abs(share - expected));
        }
    EXPECT_LT(outside, 1e-6);
    propagate(spectrum, {z, 0, 0, 1, 1});
    const double f = 1 / period, fz = std::sqrt(1 / (wavelength * wavelength) - f * f);
    EXPECT_LT(worst(wave_of(spectrum, 400, 32),
                    [&](double x, double) {
                        return 0.5 * unit_phasor(z / wavelength) + 0.5 * std::cos(2 * pi * f * x) * unit_phasor(fz * z);
                    }),
              1e-5);
}

TEST(Elements, names_a_lens_that_would_do_where_one_is_too_steep_for_the_samples) {
    Wave wave({{64, 64, 4_um, 4_um, 0, 0}, wavelength}, {});
    try {
        thin_lens(wave, 0, 0, 10_mm, 20_mm);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find("3.165 mm"), std::string::npos) << error.what();
    }
    EXPECT_THROW(thin_lens(wave, 0, 0, 1_mm, 0), Error);
    EXPECT_THROW(circular_aperture(wave, 0, 0, -1_mm, PupilEdge({0.1, 0.1, 0, 1e-3}, wavelength)), Error);
}

// A Gaussian beam on a plane tilted about both axes, with and without propagation in between, and back.
TEST(Tilt, a_tilted_plane_cuts_a_gaussian_beam) {
    const Grid plane{256, 256, 0.8_um, 0.8_um, 0.1_mm, -0.2_mm};
    const double w = 15_um;
    const auto beam = [&](double x, double y, double z) {
        return gaussian_beam(w, x - plane.center_x, y - plane.center_y, z);
    };
    const Field field = sampled(plane, [&](double x, double y) { return beam(x, y, 0); });
    const Grid window = padded(plane, 2 * plane.size_x(), 2 * plane.size_y());
    const Spectrum spectrum = spectrum_of(field, 0, window, Band::of(plane));
    const double a = 20_deg, b = -12_deg;
    Orientation turned;
    turned.x = {std::cos(a), 0, -std::sin(a)};
    turned.y = normalize(cross({std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b)}, turned.x));
    // A band around the beam's direction on the new plane.
    const double fx = turned.x.z / wavelength, fy = turned.y.z / wavelength, half = 0.1 / wavelength;
    Grid fine = window;
    fine.pitch_x = fine.pitch_y = 0.5_um;
    fine.width = fine.height = 1024;
    const Spectrum across = tilt(spectrum, turned, fine, {fx - half, fx + half, fy - half, fy + half});
    const Wave cut = wave_of(across, fine.width, fine.height);
    EXPECT_LT(worst(
                  cut,
                  [&](double x, double y) {
                      const Vec3 p = (x - plane.center_x) * turned.x + (y - plane.center_y) * turned.y;
                      return gaussian_beam(w, p.x, p.y, p.z);
                  },
                  [&](double x, double y) {
                      return std::abs(x - plane.center_x) < 60_um && std::abs(y - plane.center_y) < 60_um;
                  }),
              1e-3);

    const Orientation back{{turned.x.x, turned.y.x, turned.z().x}, {turned.x.y, turned.y.y, turned.z().y}};
    const Spectrum returned = tilt(across, back, window, {-half, half, -half, half});
    const Wave again = wave_of(returned, window.width, window.height);
    EXPECT_LT(worst(
                  again, [&](double x, double y) { return beam(x, y, 0); },
                  [&](double x, double y) {
                      return std::abs(x - plane.center_x) < 60_um && std::abs(y - plane.center_y) < 60_um;
                  }),
              2e-3);
    EXPECT_THROW(tilt(spectrum, {{1, 0, 0}, {0.1, 1, 0}}, window, Band::of(plane)), Error);
}

TEST(Spectrum, is_the_same_for_any_number_of_threads_and_in_a_file) {
    const Grid plane{150, 130, 1_um, 1_um, 0, 0};
    const Field field = noise(plane);
    const auto run = [&](const ScratchOptions& scratch) {
        Spectrum spectrum = spectrum_of(field, 0, padded(plane, 300_um, 280_um), {-1e5, 3e5, -2e5, 2e5}, scratch);
        propagate(spectrum, {1_mm, 50_um, 0});
        return wave_of(spectrum, 320, 300, scratch);
    };
    const Wave all = run({}), in_file = run({0, ::testing::TempDir()});
    const ThreadLimit one(1);
    const Wave alone = run({});
    EXPECT_TRUE(std::ranges::equal(all.samples.view().elements(), alone.samples.view().elements()));
    EXPECT_TRUE(std::ranges::equal(all.samples.view().elements(), in_file.samples.view().elements()));
}

// The band contains all directions of light from one rectangle to another, and few others.
TEST(BandBetween, holds_every_direction_tightly) {
    const Rectangle from{Grid{10, 8, 1_mm, 1_mm, 1_mm, 0}}, to{Grid{3, 3, 1_mm, 1_mm, 40_mm, -5_mm}};
    const double z = 80_mm;
    const Band band = band_between(from, to, z, wavelength);
    Band seen{1e99, -1e99, 1e99, -1e99};
    for (int i = 0; i < 6 * 6 * 6 * 6; ++i) {
        const auto part = [&](int k, double low, double high) { return low + (high - low) * k / 5; };
        const Vec3 direction{part(i % 6, to.left, to.right) - part(i / 6 % 6, from.left, from.right),
                             part(i / 36 % 6, to.bottom, to.top) - part(i / 216, from.bottom, from.top), z};
        const Vec3 f = direction / (length(direction) * wavelength);
        seen = {std::min(seen.low_x, f.x), std::max(seen.high_x, f.x), std::min(seen.low_y, f.y),
                std::max(seen.high_y, f.y)};
    }
    const double slack = 1e-6 / wavelength;
    for (const auto& [outer, inner] : {std::pair{-band.low_x, -seen.low_x},
                                       {band.high_x, seen.high_x},
                                       {-band.low_y, -seen.low_y},
                                       {band.high_y, seen.high_y}}) {
        EXPECT_GE(outer, inner - slack);
        EXPECT_LT(outer - inner, 1e-3 / wavelength);
    }
}

TEST(Spectrum, refuses_invalid_windows_bands_and_distances) {
    const Grid plane{64, 64, 1_um, 1_um, 0, 0};
    const Field field(FieldGrid{plane, wavelength});
    EXPECT_THROW(hogel::propagate(field, std::nan("")), Error);
    EXPECT_THROW(spectrum_of(field, 0, {62, 64, 1_um, 1_um, 0, 0}, Band::of(plane)), Error);
    EXPECT_THROW(spectrum_of(field, 0, plane, {6e5, 7e5, -1e5, 1e5}), Error);
    EXPECT_THROW(spectrum_of(field, 0, plane, Band::of(plane), {100, {}}), Error);
    EXPECT_THROW(wave_of(spectrum_of(field, 0, plane, Band::of(plane)), 32, 64), Error);
}

}  // namespace
}  // namespace hogel::optics
