// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "hogel/core/test_targets.h"
#include "hogel/math/fft.h"
#include "hogel/math/fourier/plain.h"
#include "hogel/math/fourier/test_lines.h"
#include "hogel/resources.h"

namespace hogel::math::fourier {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(FourierTransforms);

using Complex = std::complex<float>;

// Returns Σ_j x_j e^{-2πi jk/n} by its definition.
ExactLine direct_sums(const ExactLine& x) {
    const std::size_t n = x.size();
    ExactLine roots(n), result(n);
    for (std::size_t j = 0; j < n; ++j)
        roots[j] = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(n));
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < n; ++j) result[k] += x[j] * roots[j * k % n];
    return result;
}

ExactLine conjugate(ExactLine x) {
    for (std::complex<double>& value : x) value = std::conj(value);
    return x;
}

ExactLine plain(ExactLine x) {
    transform_plain_double(x);
    return x;
}

Line forward(Line x) {
    Fft1(x.size()).forward(x.data());
    return x;
}
Line backward(Line x) {
    Fft1(x.size()).backward(x.data());
    return x;
}

// Lengths of every method: each radix, convolutions, batches of lines, and long lines.
const std::size_t some_lengths[] = {1,   2,   3,   4,    5,    7,    8,    11,   13,   16,   17,   23,   24,
                                    25,  30,  31,  49,   60,   64,   97,   100,  121,  127,  169,  256,  343,
                                    480, 512, 600, 1000, 1024, 1031, 1080, 1287, 2187, 4096, 4099, 5000, 10007};

// Transforms the line as a row of one array and a column of another, among lines of noise that fill more than a batch.
// Returns the larger error.
double error_of_many(const Line& x, const ExactLine& expected, bool is_forward) {
    constexpr std::size_t count = 21;
    const std::size_t length = x.size();
    const Fft1 fft(length);
    double worst = 0;
    Array<Complex, 2> rows({count, length}), columns({length, count});
    for (std::size_t i = 0; i < count; ++i) {
        const Line line = i == 5 || i == 20 ? x : noise(length, static_cast<std::uint32_t>(i + 2));
        for (std::size_t j = 0; j < length; ++j) rows(i, j) = columns(j, i) = line[j];
    }
    transform_rows(rows, fft, is_forward);
    math::transform_columns(columns, fft, is_forward);
    for (const std::size_t i : {5, 20})
        worst =
            std::max({worst, relative_error(&rows(i, 0), expected), relative_error(&columns(0, i), expected, count)});
    return worst;
}

TEST(PlainFourierTransform, gives_the_sums_in_both_precisions) {
    for (std::size_t n = 1; n <= 300; ++n) {
        Line x = noise(n);
        const ExactLine expected = direct_sums(exact(x));
        const ExactLine result = plain(exact(x));
        for (std::size_t k = 0; k < n; ++k)
            ASSERT_LT(std::abs(result[k] - expected[k]), 1e-13 * static_cast<double>(n + 20)) << n;
        transform_plain(x);
        ASSERT_LT(relative_error(x.data(), expected), 5e-7) << n;
    }
}

TEST_P(FourierTransforms, give_the_sums_for_every_length_up_to_300) {
    for (std::size_t n = 1; n <= 300; ++n) {
        const Line x = noise(n);
        const ExactLine there = direct_sums(exact(x)), back = conjugate(direct_sums(conjugate(exact(x))));
        ASSERT_LT(relative_error(forward(x).data(), there), allowed_error(n)) << n;
        ASSERT_LT(relative_error(backward(x).data(), back), allowed_error(n)) << n;
        ASSERT_LT(error_of_many(x, there, true), allowed_error(n)) << n;
        ASSERT_LT(error_of_many(x, back, false), allowed_error(n)) << n;
    }
}

TEST_P(FourierTransforms, give_the_plain_result_for_large_lengths) {
    static std::map<std::size_t, ExactLine> results;  // of all targets
    for (const std::size_t n :
         {360,  512,  720,  1000, 1024, 1031, 1080,  1920,  2048,  2062,  2187,  2401,   3125,
          3840, 4096, 4099, 5120, 6561, 8192, 10000, 10007, 16384, 65536, 65537, 100000, 1 << 20}) {
        const Line x = noise(n);
        if (!results.contains(n)) results[n] = plain(exact(x));
        EXPECT_LT(relative_error(forward(x).data(), results[n]), allowed_error(n)) << n;
        if (n > 10007) continue;
        EXPECT_LT(error_of_many(x, results[n], true), allowed_error(n)) << n;
    }
}

TEST_P(FourierTransforms, of_a_delta_is_a_wave) {
    for (const std::size_t n : some_lengths) {
        const std::size_t offset = n / 3;
        Line x(n);
        x[offset] = 1;
        ExactLine wave(n);
        for (std::size_t k = 0; k < n; ++k)
            wave[k] =
                std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(offset * k % n) / static_cast<double>(n));
        EXPECT_LT(relative_error(forward(x).data(), wave), allowed_error(n)) << n;
        EXPECT_LT(relative_error(backward(x).data(), conjugate(wave)), allowed_error(n)) << n;
    }
}

TEST_P(FourierTransforms, of_a_wave_is_a_delta) {
    for (const std::size_t n : some_lengths) {
        const std::size_t frequency = 2 * n / 3;
        Line x(n);
        for (std::size_t j = 0; j < n; ++j)
            x[j] = Complex(std::polar(
                1.0, 2 * std::numbers::pi * static_cast<double>(frequency * j % n) / static_cast<double>(n)));
        ExactLine delta(n);
        delta[frequency] = static_cast<double>(n);
        EXPECT_LT(relative_error(forward(x).data(), delta), allowed_error(n)) << n;
    }
}

// A Gaussian of standard deviation σ samples, much narrower than the line and wider than a sample, becomes
// σ√(2π) e^{-2π²σ²f²} at frequency f per sample.
TEST_P(FourierTransforms, of_a_gaussian_is_a_gaussian) {
    for (const std::size_t n : {100, 127, 256, 480, 1031, 4096}) {
        const double size = static_cast<double>(n), sigma = std::sqrt(size / (2 * std::numbers::pi));
        const auto around = [&](std::size_t j) { return static_cast<double>(j) - (j > n / 2 ? size : 0); };
        Line x(n);
        ExactLine expected(n);
        for (std::size_t j = 0; j < n; ++j) {
            x[j] = static_cast<float>(std::exp(-0.5 * std::pow(around(j) / sigma, 2)));
            expected[j] = sigma * std::sqrt(2 * std::numbers::pi) *
                          std::exp(-2 * std::pow(std::numbers::pi * sigma * around(j) / size, 2));
        }
        EXPECT_LT(relative_error(forward(x).data(), expected), allowed_error(n)) << n;
    }
}

TEST_P(FourierTransforms, keep_power) {
    for (const std::size_t n : some_lengths) {
        const Line x = noise(n), y = forward(x);
        double before = 0, after = 0;
        for (std::size_t i = 0; i < n; ++i) before += std::norm(x[i]), after += std::norm(y[i]);
        EXPECT_NEAR(after / before / static_cast<double>(n), 1, 2e-6) << n;
    }
}

TEST_P(FourierTransforms, are_linear_and_turn_shifts_into_phases) {
    for (const std::size_t n : some_lengths) {
        const Line x = noise(n), y = noise(n, 2), of_x = forward(x), of_y = forward(y);
        const Complex factor(0.5f, -2);
        const std::size_t shift = n / 2;
        Line sum(n);
        ExactLine expected(n);
        for (std::size_t i = 0; i < n; ++i) {
            sum[(i + shift) % n] = x[i] + factor * y[i];
            expected[i] =
                std::complex<double>(of_x[i] + factor * of_y[i]) *
                std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(shift * i % n) / static_cast<double>(n));
        }
        EXPECT_LT(relative_error(forward(sum).data(), expected), 2 * allowed_error(n)) << n;
    }
}

TEST_P(FourierTransforms, back_and_forth_give_the_line_again) {
    for (const std::size_t n : some_lengths) {
        const Line x = noise(n);
        Line y = backward(forward(x));
        for (Complex& value : y) value /= static_cast<float>(n);
        EXPECT_LT(relative_error(y.data(), exact(x)), 2 * allowed_error(n)) << n;
    }
}

TEST_P(FourierTransforms, turn_convolutions_into_products) {
    for (const std::size_t n : {7, 24, 60, 97, 256, 480}) {
        const Line x = noise(n), y = noise(n, 2);
        ExactLine expected(n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                expected[(i + j) % n] += std::complex<double>(x[i]) * std::complex<double>(y[j]);
        const Line of_x = forward(x), of_y = forward(y);
        Line product(n);
        for (std::size_t i = 0; i < n; ++i) product[i] = of_x[i] * of_y[i] / static_cast<float>(n);
        EXPECT_LT(relative_error(backward(product).data(), expected), 3 * allowed_error(n)) << n;
    }
}

#ifndef HOGEL_FFTW  // which has other plans for data that is not aligned
// A line gives the same bytes alone and in a batch, and at any alignment.
TEST_P(FourierTransforms, do_not_depend_on_other_lines_or_on_alignment) {
    for (const std::size_t n : {1, 2, 17, 30, 60, 97, 256, 480, 512, 1031, 1080, 4096, 5000}) {
        const Fft1 fft(n);
        const Line all = noise(n * 35);
        Array<Complex, 2> rows({35, n}), columns({n, 35});
        std::copy(all.begin(), all.end(), rows.data());
        std::copy(all.begin(), all.end(), columns.data());
        transform_rows(rows, fft, true);
        math::transform_columns(columns, fft, true);
        for (const std::size_t i : {0, 7, 16, 31, 34}) {
            Line some(2 * n + 1);
            const View<Complex, 2> row(some.data() + 1, {1, n}), column(some.data() + 1, {n, 2});
            std::copy_n(all.data() + i * n, n, row.data());
            transform_rows(row, fft, true);
            for (std::size_t j = 0; j < n; ++j) ASSERT_EQ(row(0, j), rows(i, j)) << n;
            for (std::size_t j = 0; j < n; ++j) column(j, 0) = column(j, 1) = all[j * 35 + i];
            math::transform_columns(column, fft, true);
            for (std::size_t j = 0; j < n; ++j) ASSERT_EQ(column(j, 1), columns(j, i)) << n;
        }
        Line aligned(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n)), shifted(n + 1);
        std::copy(aligned.begin(), aligned.end(), shifted.begin() + 1);
        fft.backward(aligned.data());
        fft.backward(shifted.data() + 1);
        for (std::size_t j = 0; j < n; ++j) ASSERT_EQ(aligned[j], shifted[j + 1]) << n;
    }
}
#endif

TEST_P(FourierTransforms, of_arrays_are_those_of_rows_and_then_of_columns) {
    for (const auto& [height, width] : {std::pair<std::size_t, std::size_t>{1, 30},
                                        {30, 1},
                                        {30, 30},
                                        {48, 60},
                                        {17, 50},
                                        {64, 64},
                                        {270, 251},
                                        {1, 70000}}) {
        const Line x = noise(height * width);
        Array<Complex, 2> whole({height, width}), steps({height, width});
        std::copy(x.begin(), x.end(), whole.data());
        std::copy(x.begin(), x.end(), steps.data());
        Fft2(height, width).backward(whole);
        transform_rows(steps, Fft1(width), false);
        math::transform_columns(steps, Fft1(height), false);
        EXPECT_LT(relative_error(whole.data(), {steps.elements().begin(), steps.elements().end()}), 2e-6)
            << height << " " << width;
        Array<Complex, 2> again({height, width});
        std::copy(x.begin(), x.end(), again.data());
        const ThreadLimit one(1);
        Fft2(height, width).backward(again);
        EXPECT_TRUE(std::ranges::equal(again.elements(), whole.elements())) << "for any number of threads";
    }
}

}  // namespace
}  // namespace hogel::math::fourier
