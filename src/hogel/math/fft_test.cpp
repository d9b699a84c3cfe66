// SPDX-License-Identifier: Apache-2.0
#include "hogel/math/fft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "hogel/core/test_targets.h"
#include "hogel/error.h"
#include "hogel/math/column_fft.h"

namespace hogel::math {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(ColumnFftKernels);

using Complex = std::complex<float>;

Array<Complex, 2> noise(std::size_t height, std::size_t width) {
    Array<Complex, 2> values({height, width});
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    for (Complex& value : values.elements()) value = {normal(random), normal(random)};
    return values;
}

TEST(Fft2, backward_is_the_sum_of_waves_with_a_positive_exponent) {
    const std::size_t height = 6, width = 5;
    const Array<Complex, 2> spectrum = noise(height, width);
    Array<Complex, 2> values = spectrum;
    Fft2(height, width).backward(values);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            std::complex<double> sum = 0;
            for (std::size_t k = 0; k < height; ++k)
                for (std::size_t j = 0; j < width; ++j) {
                    const double cycles = static_cast<double>(k * y) / height + static_cast<double>(j * x) / width;
                    sum += std::complex<double>(spectrum(k, j)) * std::polar(1.0, 2 * std::numbers::pi * cycles);
                }
            EXPECT_LT(std::abs(std::complex<double>(values(y, x)) - sum), 1e-5);
        }
}

// Large arrays, which are transformed line by line, are compared with some of the sums and transformed back.
TEST(Fft2, large_arrays_give_the_same_sum) {
    const std::size_t height = 150, width = 203;
    const Array<Complex, 2> spectrum = noise(height, width);
    Array<Complex, 2> values = spectrum;
    const Fft2 fft(height, width);
    fft.backward(values);
    for (const auto& [y, x] : {std::pair<std::size_t, std::size_t>{0, 0}, {1, 202}, {149, 17}, {77, 100}}) {
        std::complex<double> sum = 0;
        for (std::size_t k = 0; k < height; ++k)
            for (std::size_t j = 0; j < width; ++j) {
                const double cycles = static_cast<double>(k * y) / height + static_cast<double>(j * x) / width;
                sum += std::complex<double>(spectrum(k, j)) * std::polar(1.0, 2 * std::numbers::pi * cycles);
            }
        EXPECT_LT(std::abs(std::complex<double>(values(y, x)) - sum), 2e-4) << y << " " << x;
    }
    fft.forward(values);
    for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_LT(std::abs(values.data()[i] / float(height * width) - spectrum.data()[i]), 1e-5f);
}

// Compares ColumnFft, for power-of-two lengths, with sums along columns.
TEST_P(ColumnFftKernels, give_the_sum_of_waves_for_every_length_and_direction) {
    for (std::size_t length = ColumnFft::shortest; length <= 512; length *= 2) {
        const std::size_t columns = 2 * ColumnFft::batch_columns, row = columns + 3;
        if (!ColumnFft::can(length, columns)) return;  // targets without vectors have none
        const Array<Complex, 2> from = noise(length, row);
        for (const bool forward : {false, true}) {
            Array<Complex, 2> to({length, row + 1}, Complex(7, 7));
            ColumnFft(length).transform(forward, from.data(), row, &to(0, 1), row + 1, columns);
            double worst = 0;
            for (std::size_t column = 0; column < columns; column += 5)
                for (std::size_t y = 0; y < length; ++y) {
                    std::complex<double> sum = 0;
                    for (std::size_t j = 0; j < length; ++j)
                        sum += std::complex<double>(from(j, column)) *
                               std::polar(1.0, (forward ? -2 : 2) * std::numbers::pi *
                                                   static_cast<double>(j * y % length) / static_cast<double>(length));
                    worst = std::max(worst, std::abs(std::complex<double>(to(y, column + 1)) - sum));
                }
            EXPECT_LT(worst, 4e-7 * static_cast<double>(length)) << length << " " << forward;
            EXPECT_EQ(to(length - 1, 0), Complex(7, 7));
            EXPECT_EQ(to(length - 1, columns + 1), Complex(7, 7)) << "writes nothing beside the columns";
        }
    }
    EXPECT_FALSE(ColumnFft::can(48, 32));
    EXPECT_FALSE(ColumnFft::can(64, 24));
}

// Transforms in place, and to rows of an array that may be wider than the columns.
TEST_P(ColumnFftKernels, give_the_same_in_split_layout) {
    const std::size_t length = 32, columns = 32;
    if (!ColumnFft::can(length, columns)) return;  // targets without vectors have none
    const Array<Complex, 2> from = noise(length, columns);
    Array<float, 4> apart({columns / 16, length, 2, 16});
    for (std::size_t r = 0; r < length; ++r)
        for (std::size_t c = 0; c < columns; ++c) {
            apart(c / 16, r, 0, c % 16) = from(r, c).real();
            apart(c / 16, r, 1, c % 16) = from(r, c).imag();
        }
    const ColumnFft fft(length);
    Array<Complex, 2> expected({length, columns});
    fft.transform(false, from.data(), columns, expected.data(), columns, columns);
    for (const std::size_t row : {columns, columns + 8, columns + 3}) {
        Array<Complex, 2> to({length, row}, Complex(7, 7));
        fft.backward_split(apart.data(), to.data(), row, columns);
        for (std::size_t r = 0; r < length; ++r) {
            for (std::size_t c = 0; c < columns; ++c) ASSERT_EQ(to(r, c), expected(r, c)) << row;
            for (std::size_t c = columns; c < row; ++c) ASSERT_EQ(to(r, c), Complex(7, 7)) << row;
        }
    }
    fft.backward_split(&apart(1, 0, 0, 0));
    for (std::size_t r = 0; r < length; ++r)
        for (std::size_t c = 0; c < 16; ++c)
            ASSERT_EQ(Complex(apart(1, r, 0, c), apart(1, r, 1, c)), expected(r, 16 + c));
}

TEST(Fft2, backward_writes_its_result_to_another_array) {
    for (const std::size_t n : {20, 64}) {
        Array<Complex, 2> values = noise(n, n), same = values, out({n, n + 5});
        const Fft2 fft(n, n);
        fft.backward(values);
        fft.backward(same, &out(0, 2), n + 5);
        for (std::size_t y = 0; y < n; ++y)
            for (std::size_t x = 0; x < n; ++x) ASSERT_EQ(out(y, x + 2), values(y, x)) << n;
    }
}

TEST(Fft2, forward_undoes_backward_on_unaligned_data_too) {
    const std::size_t n = 40;
    const Array<Complex, 2> original = noise(n, n);
    std::vector<Complex> storage(n * n + 1);
    const View<Complex, 2> odd(storage.data() + 1, {n, n});
    std::copy(original.elements().begin(), original.elements().end(), odd.data());
    const Fft2 fft(n, n);
    fft.backward(odd);
    fft.forward(odd);
    for (std::size_t i = 0; i < n * n; ++i)
        EXPECT_LT(std::abs(odd.data()[i] / float(n * n) - original.elements()[i]), 1e-5f);
}

// A large array is transformed line by line, with the same result.
TEST(Fft2, a_large_array_is_transformed_as_a_small_one) {
    const std::size_t height = 270, width = 251;
    Array<Complex, 2> values({height, width});
    // Three waves, each of which must give one sample of the spectrum.
    const std::array<std::array<std::size_t, 2>, 3> waves{{{3, 200}, {269, 0}, {100, 17}}};
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t w = 0; w < waves.size(); ++w) {
                const double cycles = double(waves[w][0] * y) / height + double(waves[w][1] * x) / width;
                values(y, x) += Complex(std::polar(1.0 + double(w), 2 * std::numbers::pi * cycles));
            }
    const Array<Complex, 2> original = values;
    const Fft2 fft(height, width);
    fft.forward(values);
    for (std::size_t w = 0; w < waves.size(); ++w)
        values(waves[w][0], waves[w][1]) -= Complex(float(height * width) * (1.0f + float(w)));
    for (const Complex& rest : values.elements()) EXPECT_LT(std::abs(rest) / float(height * width), 2e-6f);
    values = original;
    fft.backward(values);
    fft.forward(values);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_LT(std::abs(values.data()[i] / float(height * width) - original.data()[i]), 1e-5f);
}

TEST(Fft2, a_wrong_shape_or_an_empty_size_is_an_error) {
    Array<Complex, 2> values({4, 5});
    EXPECT_THROW(Fft2(5, 4).forward(values), Error);
    EXPECT_THROW(Fft2(0, 4), Error);
}

TEST(GoodFftSize, is_the_next_seven_smooth_number) {
    EXPECT_EQ(good_fft_size(1), 1u);
    EXPECT_EQ(good_fft_size(11), 12u);
    EXPECT_EQ(good_fft_size(1153), 1176u);
    EXPECT_EQ(good_fft_size(2048), 2048u);
}

}  // namespace
}  // namespace hogel::math
