// SPDX-License-Identifier: Apache-2.0
#include "hogel/pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "hogel/core/random.h"
#include "hogel/error.h"
#include "hogel/math/fft.h"
#include "hogel/units.h"

namespace hogel::patterns {
namespace {

using namespace literals;
using Complex = std::complex<float>;

constexpr std::size_t side = 192;

Field empty_field(double pitch = 8_um) { return Field(FieldGrid{{side, side, pitch, pitch, 0, 0}, 633_nm}); }

// Plane waves of all frequencies up to `band` cycles per pixel with random phases, as from a diffuse object.
Field speckle(double band, std::uint32_t seed = 1) {
    Field field = empty_field();
    const auto max_index = std::ptrdiff_t(band * side);
    for (std::ptrdiff_t j = -max_index; j <= max_index; ++j)
        for (std::ptrdiff_t i = -max_index; i <= max_index; ++i) {
            const auto bits = core::philox({std::uint32_t(i), std::uint32_t(j), 0, 0}, {seed, 0})[0];
            field.samples(std::size_t(j + std::ptrdiff_t(side)) % side, std::size_t(i + std::ptrdiff_t(side)) % side) =
                Complex(std::polar(1.0, 2 * std::numbers::pi * (bits / 4294967296.0)));
        }
    math::Fft2(side, side).backward(field.samples);
    return field;
}

// One plane wave whose period is no whole number of pixels.
Field plane_wave(double columns = 0.0137, double rows = 0.0271) {
    Field field = empty_field();
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x)
            field.samples(y, x) =
                Complex(std::polar(3.0, 2 * std::numbers::pi * (columns * double(x) + rows * double(y))));
    return field;
}

PatternOptions options_for(Encoding encoding) {
    PatternOptions options;
    options.encoding = encoding;
    options.modulator = {"test", side, side, 8_um, 256};
    options.clip = 0;
    return options;
}

struct Case {
    Encoding encoding;
    double efficiency;  // theoretical value for a plane wave
};

class PlaneWave : public testing::TestWithParam<Case> {};

// The first order of a sinusoidal amplitude is 1/4, of a square one 1/π, of three or four components 1/3
// and 1/4; three components reach 2/√3 of the modulus, so all are scaled down by that.
TEST_P(PlaneWave, is_encoded_with_the_efficiency_of_theory) {
    const Pattern pattern = encode_pattern(plane_wave(), options_for(GetParam().encoding));
    EXPECT_NEAR(pattern.efficiency / GetParam().efficiency, 1, 0.02);
}

constexpr double pi2 = std::numbers::pi * std::numbers::pi;
INSTANTIATE_TEST_SUITE_P(Encodings, PlaneWave,
                         testing::Values(Case{Encoding::phase, 1}, Case{Encoding::double_phase, 1},
                                         Case{Encoding::intensity, 1 / 16.0}, Case{Encoding::bipolar, 1 / 16.0},
                                         Case{Encoding::burckhardt, 1 / 12.0}, Case{Encoding::lee, 1 / 16.0},
                                         Case{Encoding::binary, 1 / pi2}));

// The |F|² of a random sum of waves has an exponential distribution. Its phase alone keeps E²(|F|)/E(|F|²) = π/4 of the
// light. Encodings that are linear in F keep the mean of |F|² divided by its maximum, times their efficiency for a
// plane wave.
TEST(Pattern, speckle_is_encoded_with_the_efficiency_of_theory) {
    const Field field = speckle(0.1);
    EXPECT_NEAR(encode_pattern(field, options_for(Encoding::phase)).efficiency, std::numbers::pi / 4, 0.01);
    double mean = 0, peak = 0;
    for (const Complex& value : field.samples.elements()) {
        mean += std::norm(value) / (side * side);
        peak = std::max(peak, double(std::norm(value)));
    }
    for (const auto& [encoding, factor] :
         {Case{Encoding::double_phase, 1}, Case{Encoding::bipolar, 1 / 16.0}, Case{Encoding::burckhardt, 1 / 12.0}})
        EXPECT_NEAR(encode_pattern(field, options_for(encoding)).efficiency / (factor * mean / peak), 1, 0.05);
}

// The carrier's order of the pattern, low-passed to the field's band, is exactly the field.
class Order : public testing::TestWithParam<Encoding> {};

TEST_P(Order, holds_the_field_alone) {
    const double band = 0.08;
    const Field field = speckle(band);
    const Pattern pattern = encode_pattern(field, options_for(GetParam()));
    Array<Complex, 2> order = transmission(pattern, GetParam());
    const double frequency = std::sin(pattern.reference_angle) * 8_um / 633_nm;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x)
            order(y, x) *= Complex(std::polar(1.0, 2 * std::numbers::pi * frequency * double(x)));
    const math::Fft2 fft(side, side);
    fft.forward(order);
    Array<Complex, 2> expected = field.samples;
    fft.forward(expected);
    const auto reach = std::ptrdiff_t(band * side);
    std::complex<double> product = 0;
    double energy = 0, other = 0;
    for (std::ptrdiff_t j = -reach; j <= reach; ++j)
        for (std::ptrdiff_t i = -reach; i <= reach; ++i) {
            const std::size_t row = std::size_t(j + std::ptrdiff_t(side)) % side,
                              column = std::size_t(i + std::ptrdiff_t(side)) % side;
            const std::complex<double> a = order(row, column), b = expected(row, column);
            product += a * std::conj(b);
            energy += std::norm(a);
            other += std::norm(b);
        }
    const double likeness = std::norm(product) / (energy * other);
    EXPECT_GT(likeness, 0.95);
}

INSTANTIATE_TEST_SUITE_P(Encodings, Order,
                         testing::Values(Encoding::double_phase, Encoding::intensity, Encoding::bipolar,
                                         Encoding::burckhardt, Encoding::lee));

// Relative error of a pattern's local spectra in squares from a given pixel on, up to a frequency if given.
double spectral_error(const Pattern& pattern, Encoding encoding, const Field& field, std::size_t first = 0,
                      std::size_t reach = side) {
    constexpr std::size_t window = 24;
    const Array<Complex, 2> actual = transmission(pattern, encoding);
    const math::Fft2 fft(window, window);
    double error = 0, all = 0;
    for (std::size_t y0 = first; y0 + window <= side; y0 += window)
        for (std::size_t x0 = first; x0 + window <= side; x0 += window) {
            Array<Complex, 2> a({window, window}), b({window, window});
            for (std::size_t y = 0; y < window; ++y)
                for (std::size_t x = 0; x < window; ++x) {
                    a(y, x) = actual(y0 + y, x0 + x);
                    b(y, x) = field.samples(y0 + y, x0 + x);
                }
            fft.forward(a);
            fft.forward(b);
            double product = 0, energy = 0, target = 0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                const std::size_t row = i / window, column = i % window;
                if (std::max(std::min(row, window - row), std::min(column, window - column)) > reach) continue;
                product += std::abs(a.data()[i]) * std::abs(b.data()[i]);
                energy += std::norm(a.data()[i]);
                target += std::norm(b.data()[i]);
            }
            error += target - product * product / energy;
            all += target;
        }
    return error / all;
}

TEST(Pattern, iteration_brings_the_light_field_nearer_than_the_phase_alone) {
    const Field field = speckle(0.2);
    const auto error = [&](Encoding encoding) {
        PatternOptions options = options_for(encoding);
        options.window = 24;
        return spectral_error(encode_pattern(field, options), encoding, field);
    };
    EXPECT_LT(error(Encoding::gerchberg_saxton), 0.25 * error(Encoding::phase));
}

// A smooth phase with a varying modulus that has zeros: the light of a picture on a lens.
Field smooth_phase() {
    Field field = empty_field();
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            const double u = double(x) / side - 0.5, v = double(y) / side - 0.5;
            const double modulus = 0.15 + std::abs(std::sin(9 * u + 4 * v) * std::cos(7 * v - 3 * u * u));
            field.samples(y, x) = Complex(std::polar(modulus, 30 * u * u + 22 * v * v + 6 * u));
        }
    return field;
}

PatternOptions descent_options(std::size_t iterations = 0) {
    PatternOptions options = options_for(Encoding::gradient);
    options.window = 24;
    options.iterations = iterations;
    return options;
}

TEST(Pattern, descent_converges_to_the_field_within_its_band) {
    for (const Field& field : {speckle(0.2), speckle(0.1, 3), smooth_phase()}) {
        const Pattern pattern = encode_pattern(field, descent_options());
        EXPECT_GT(pattern.correlation, 0.995);
        EXPECT_GT(pattern.iterations, 5u);
        EXPECT_LT(pattern.iterations, 40u);
        EXPECT_GT(pattern.efficiency, 0.25);
        // Iterations beyond convergence change nothing; fewer are less accurate.
        const Pattern limited = encode_pattern(field, descent_options(pattern.iterations));
        EXPECT_TRUE(std::ranges::equal(limited.levels.elements(), pattern.levels.elements()));
        const Pattern fewer = encode_pattern(field, descent_options(3));
        EXPECT_EQ(fewer.iterations, 3u);
        EXPECT_LT(fewer.correlation, pattern.correlation);
    }
}

// Correlation of the light that an aperture passes with the field.
template <class IsInside>
double correlation_behind(Array<Complex, 2> actual, Array<Complex, 2> expected, const IsInside& is_inside) {
    const math::Fft2 fft(side, side);
    fft.forward(actual);
    fft.forward(expected);
    std::complex<double> product = 0;
    double energy = 0, all = 0;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            const std::complex<double> a = actual(y, x), b = expected(y, x);
            all += std::norm(b);
            if (!is_inside(x, y)) continue;
            product += a * std::conj(b);
            energy += std::norm(a);
        }
    return std::abs(product) / std::sqrt(energy * all);
}

// A pattern's correlation is that of its order with the field, behind an aperture of the band's shape.
TEST(Pattern, its_correlation_is_that_behind_an_aperture) {
    const Field field = speckle(0.1);
    const Pattern pattern = encode_pattern(field, descent_options());
    const auto is_inside = [](std::size_t x, std::size_t y) {
        return std::max(std::min(y, side - y), std::min(x, side - x)) <= std::size_t(0.1 * side);
    };
    EXPECT_NEAR(correlation_behind(transmission(pattern, Encoding::gradient), field.samples, is_inside),
                pattern.correlation, 0.003);
}

TEST(Pattern, the_encoding_that_suits_a_field_is_the_first_that_shows_it) {
    PatternOptions options = descent_options();
    EXPECT_EQ(suitable_encoding(plane_wave(), options), Encoding::phase);
    EXPECT_EQ(suitable_encoding(speckle(0.2), options), Encoding::gradient);
    EXPECT_EQ(suitable_encoding(smooth_phase(), options), Encoding::double_phase);
    options.encoding = Encoding::phase;
    EXPECT_GT(encode_pattern(plane_wave(), options).correlation, sufficient_correlation);
    EXPECT_LT(encode_pattern(smooth_phase(), options).correlation, 0.95);
}

// A bright uniform field with a weak, fine texture: nearly all light is at frequency zero, the picture elsewhere.
Field textured(double band, double strength, double carrier = 0) {
    Field field = speckle(band, 5);
    double mean = 0;
    for (const Complex& value : field.samples.elements()) mean += std::norm(value) / (side * side);
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            Complex& value = field.samples(y, x);
            value = (1.0f + value * float(strength / std::sqrt(mean))) *
                    Complex(std::polar(1.0, 2 * std::numbers::pi * carrier * double(x)));
        }
    return field;
}

// PSNR of the intensity behind an aperture around frequency zero against the field, dB.
double psnr_behind(double radius, const Pattern& pattern, Encoding encoding, const Field& field) {
    Array<Complex, 2> actual = transmission(pattern, encoding);
    const math::Fft2 fft(side, side);
    fft.forward(actual);
    const auto frequency = [](std::size_t k) { return double(std::min(k, side - k)) / side; };
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x)
            if (std::hypot(frequency(x), frequency(y)) > radius) actual(y, x) = 0;
    fft.backward(actual);
    double product = 0, energy = 0, peak = 0, error = 0;
    for (std::size_t i = 0; i < actual.size(); ++i) {
        const double a = std::norm(actual.data()[i]), b = std::norm(field.samples.data()[i]);
        product += a * b;
        energy += a * a;
        peak = std::max(peak, b);
    }
    for (std::size_t i = 0; i < actual.size(); ++i)
        error += std::pow(product / energy * std::norm(actual.data()[i]) - std::norm(field.samples.data()[i]), 2);
    return 10 * std::log10(peak * peak * double(actual.size()) / error);
}

TEST(Pattern, what_suits_a_smooth_field_shows_its_picture_behind_the_aperture) {
    for (const double band : {0.05, 0.2}) {
        const Field field = textured(band, band < 0.1 ? 0.15 : 0.5);
        PatternOptions options = descent_options();
        options.encoding = suitable_encoding(field, options);
        const Pattern pattern = encode_pattern(field, options);
        EXPECT_EQ(options.encoding, band < 0.1 ? Encoding::double_phase : Encoding::gradient);
        EXPECT_GT(pattern.aperture.radius, band);
        EXPECT_LT(pattern.aperture.radius, 1.5 * band);
        EXPECT_EQ(pattern.aperture.x, 0);
        for (const double scale : {1.0, 1.08})
            EXPECT_GT(psnr_behind(scale * pattern.aperture.radius, pattern, options.encoding, field), 32);
    }
}

TEST(Pattern, the_aperture_is_around_the_light_of_a_field_beside_frequency_zero) {
    const Pattern pattern = encode_pattern(textured(0.05, 0.15, 0.25), options_for(Encoding::phase));
    EXPECT_NEAR(pattern.aperture.x, 0.25, 0.002);
    EXPECT_NEAR(pattern.aperture.y, 0, 0.002);
    EXPECT_NEAR(pattern.aperture.radius, 0.06, 0.01);
}

// Share of the field's order in the light behind the aperture of an amplitude pattern, widened by a tenth. Computed
// from the correlation with the field, which light of other orders lowers.
double likeness_behind(const Pattern& pattern, Encoding encoding, const Field& field) {
    Array<Complex, 2> expected = field.samples;
    const double carrier = std::sin(pattern.reference_angle) * 8_um / 633_nm;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x)
            expected(y, x) *= Complex(std::polar(1.0, -2 * std::numbers::pi * std::fmod(carrier * double(x), 1.0)));
    const Aperture& aperture = pattern.aperture;
    const double correlation =
        correlation_behind(transmission(pattern, encoding), expected, [&](std::size_t x, std::size_t y) {
            const double across = std::remainder(double(x) / side - aperture.x, 1.0),
                         down = std::remainder(double(y) / side - aperture.y, 1.0);
            return std::hypot(across, down) <= 1.1 * aperture.radius;
        });
    return correlation * correlation;
}

TEST(Pattern, of_amplitudes_has_its_aperture_around_the_order_that_shows_the_field) {
    const Field field = speckle(0.05);
    for (const Encoding encoding : {Encoding::intensity, Encoding::bipolar, Encoding::burckhardt, Encoding::lee}) {
        const Pattern pattern = encode_pattern(field, options_for(encoding));
        EXPECT_NEAR(pattern.aperture.x, -std::sin(pattern.reference_angle) * 8_um / 633_nm, 1e-9);
        EXPECT_EQ(pattern.aperture.y, 0);
        EXPECT_GT(pattern.aperture.radius, 0.05);
        EXPECT_GT(likeness_behind(pattern, encoding, field), 0.95) << int(encoding);
    }
    // At the maximum bandwidth of the field, the aperture still blocks the undiffracted light.
    const Pattern wide = encode_pattern(speckle(0.2), options_for(Encoding::bipolar));
    EXPECT_LT(1.1 * wide.aperture.radius, -wide.aperture.x + 1e-9);
}

TEST(Pattern, a_field_that_fills_the_band_of_the_modulator_correlates_little) {
    const Pattern pattern = encode_pattern(speckle(0.49), descent_options());
    EXPECT_EQ(pattern.aperture.radius, 0.4);
    EXPECT_LT(pattern.correlation, 0.8);
}

// Light of the stated power gives the pattern the field's amplitudes.
TEST(Pattern, shows_the_field_as_bright_as_it_is_with_light_of_its_power) {
    Field field = speckle(0.1);
    for (Complex& value : field.samples.elements()) value *= 0.37f;
    for (const Encoding encoding :
         {Encoding::phase, Encoding::double_phase, Encoding::gradient, Encoding::bipolar, Encoding::lee}) {
        const Pattern pattern = encode_pattern(field, options_for(encoding));
        const Array<Complex, 2> actual = transmission(pattern, encoding);
        const double frequency = std::sin(pattern.reference_angle) * 8_um / 633_nm;
        std::complex<double> product = 0;
        double energy = 0;
        for (std::size_t y = 0; y < side; ++y)
            for (std::size_t x = 0; x < side; ++x) {
                const Complex back = Complex(std::polar(1.0, 2 * std::numbers::pi * frequency * double(x)));
                product += std::complex<double>(actual(y, x) * back * std::conj(field.samples(y, x)));
                energy += std::norm(field.samples(y, x));
            }
        EXPECT_NEAR(std::sqrt(pattern.power) * std::abs(product) / energy, 1, 0.01) << int(encoding);
    }
}

TEST(Pattern, encodes_suitably_several_fields_by_one_encoding) {
    const auto wave = std::make_shared<Field>(plane_wave()), other = std::make_shared<Field>(speckle(0.2));
    const PatternOptions options = descent_options();
    const std::shared_ptr<const FieldSource> fields[] = {wave, other};
    const SuitablePatterns suitable = encode_suitably(fields, options);
    EXPECT_EQ(suitable.encoding, Encoding::gradient);
    ASSERT_EQ(suitable.patterns.size(), 2u);
    EXPECT_TRUE(
        std::ranges::equal(suitable.patterns[1].levels.elements(), encode_pattern(*other, options).levels.elements()));
}

TEST(Pattern, is_the_middle_of_the_field_or_has_a_border_and_rounds_to_levels) {
    const Field field = plane_wave();
    PatternOptions options = options_for(Encoding::phase);
    options.modulator = {"test", 100, 220, 8_um, 16};
    const Pattern pattern = encode_pattern(field, options);
    ASSERT_EQ(pattern.levels.shape(), (Shape<2>{220, 100}));
    for (std::size_t y = 14; y < 206; ++y)
        for (std::size_t x = 0; x < 100; ++x) {
            ASSERT_EQ(pattern.levels(y, x) % 16, 0);
            const double cycles = std::arg(field.samples(y - 14, x + 46)) / (2 * std::numbers::pi);
            ASSERT_LT(std::abs(std::remainder(pattern.levels(y, x) / 256.0 - cycles, 1.0)), 0.5 / 16 + 1e-5);
        }
    EXPECT_EQ(pattern.levels(0, 50), 0);
    // sinc² of half a level's phase, times the share of the light that is not on the border.
    EXPECT_NEAR(pattern.efficiency, std::pow(std::sin(std::numbers::pi / 16) / (std::numbers::pi / 16), 2) * 192 / 220,
                0.01);
}

void expect_usage(const Field& field, const PatternOptions& options, const std::string& part) {
    try {
        encode_pattern(field, options);
        ADD_FAILURE() << "expected: " << part;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

// Half a step of the modulator is the largest error of a phase, for few and for many levels and in every code.
TEST(Pattern, of_any_number_of_levels_shows_the_phase_within_half_a_level) {
    const Field field = plane_wave();
    for (const unsigned levels : {2u, 16u, 256u, 257u, 1024u, 65536u})
        for (const PhaseCodeInfo& row : phase_codes().rows()) {
            PatternOptions options = options_for(Encoding::phase);
            options.modulator.levels = levels;
            options.phase_code = row.code;
            const Pattern pattern = encode_pattern(field, options);
            EXPECT_EQ(pattern.max_level, std::max(levels, 256u) - 1);
            EXPECT_LE(*std::ranges::max_element(pattern.levels.elements()), pattern.max_level);
            const Array<Complex, 2> shown = transmission(pattern, options.encoding, row.code);
            // A closed code spreads its levels over one step more; both roundings of few levels add up.
            const double step = 1.0 / std::min(levels, pattern.max_level + 0u) + (levels < 256 ? 1.0 / 255 : 0);
            for (std::size_t i = 0; i < shown.size(); ++i) {
                const double wanted = pattern.values.data()[i];
                const double got = std::arg(shown.data()[i]) / (2 * std::numbers::pi);
                ASSERT_LT(std::abs(std::remainder(got - wanted, 1.0)), 0.5 * step + 1e-6) << levels << row.name;
            }
        }
}

TEST(Pattern, of_amplitudes_with_many_levels_rounds_to_the_nearest) {
    PatternOptions options = options_for(Encoding::bipolar);
    options.modulator.levels = 1024;
    const Pattern pattern = encode_pattern(speckle(0.2), options);
    EXPECT_EQ(pattern.max_level, 1023);
    for (std::size_t i = 0; i < pattern.levels.size(); ++i)
        ASSERT_LE(std::abs(pattern.levels.data()[i] - 1023.0 * pattern.values.data()[i]), 0.501);
}

TEST(Pattern, names_an_angle_or_pitch_that_would_do_where_it_refuses_one) {
    PatternOptions options = options_for(Encoding::bipolar);
    options.reference_angle = 0.2_deg;
    expect_usage(speckle(0.2), options,
                 "a reference beam at 0.20 degrees overlaps the object, whose light reaches 0.8");
    options.reference_angle = 2_deg;
    expect_usage(speckle(0.2), options, "too fine for a pitch of 8 um; 6.");
    options = options_for(Encoding::intensity);
    expect_usage(speckle(0.2), options, "too fine for a pitch of 8 um; 5.");
    expect_usage(speckle(0.2), options_for(Encoding::burckhardt), "would do");
    options.modulator.pitch = 6.4_um;
    expect_usage(speckle(0.2), options, "a pitch of 6.4 um");
    expect_usage(empty_field(), options_for(Encoding::phase), "dark");
    options = options_for(Encoding::gerchberg_saxton);
    options.window = 500;
    expect_usage(speckle(0.2), options, "500");
}

}  // namespace
}  // namespace hogel::patterns
