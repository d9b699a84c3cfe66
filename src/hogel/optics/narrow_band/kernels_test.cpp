// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/narrow_band/kernels.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "hogel/core/test_targets.h"

namespace hogel::optics::narrow_band {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(NarrowBandKernels);

using Complex = std::complex<float>;

std::vector<Complex> noise(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<Complex> values(count);
    for (Complex& value : values) value = {uniform(random), uniform(random)};
    return values;
}

// Widths around every multiple of a vector, so that each remainder loop runs.
TEST_P(NarrowBandKernels, vector_and_plain_rows_agree) {
    const std::size_t rows = 37, stride = 150;
    const std::vector<Complex> tile = noise(rows * stride), weights = noise(rows);
    for (std::size_t width = 0; width <= 140; ++width) {
        std::vector<Complex> fast(width), plain(width);
        weighted_rows(&tile[1], stride, weights, fast);
        weighted_rows_plain(&tile[1], stride, weights, plain);
        for (std::size_t x = 0; x < width; ++x) EXPECT_LT(std::abs(fast[x] - plain[x]), 1e-5f) << width << " " << x;
    }
}

TEST_P(NarrowBandKernels, vector_and_plain_lines_agree) {
    const std::vector<Complex> line = noise(1000);
    for (std::size_t taps = 0; taps <= 70; ++taps) {
        std::vector<float> doubled;
        for (const Complex& value : noise(taps)) doubled.insert(doubled.end(), 2, value.real());
        std::vector<Complex> fast(60), plain(60);
        decimated_line(line.data(), 13, doubled, fast);
        decimated_line_plain(line.data(), 13, doubled, plain);
        for (std::size_t n = 0; n < fast.size(); ++n)
            EXPECT_LT(std::abs(fast[n] - plain[n]), 1e-5f) << taps << " " << n;
    }
}

TEST_P(NarrowBandKernels, vector_and_plain_products_agree) {
    const std::vector<Complex> a = noise(80), b(a.rbegin(), a.rend());
    for (std::size_t count = 0; count <= 70; ++count) {
        std::vector<Complex> fast(count), plain(count);
        multiply(&a[1], &b[2], fast);
        multiply_plain(&a[1], &b[2], plain);
        for (std::size_t x = 0; x < count; ++x) EXPECT_LT(std::abs(fast[x] - plain[x]), 1e-6f) << count << " " << x;
    }
}

}  // namespace
}  // namespace hogel::optics::narrow_band
