// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/narrow_band/kernels.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "hogel/core/test_targets.h"

namespace hogel::camera::narrow_band {
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

// Widths around every multiple of a vector, so that each remainder loop runs; kernels that reach beyond the tile on
// both sides, and some with more taps than stay in registers.
TEST_P(NarrowBandKernels, vector_and_plain_columns_agree) {
    const std::size_t rows = 37, stride = 150;
    const std::vector<Complex> tile = noise(rows * stride), phases = noise(rows);
    for (std::size_t step : {1u, 3u, 5u, 8u})
        for (std::size_t taps : {step, 9 * step + 1, 10 * step, 11 * step}) {
            std::vector<float> weights;
            for (const Complex& value : noise(taps)) weights.push_back(value.real());
            for (std::size_t width = 0; width <= 40; ++width) {
                const std::size_t count = (rows + taps) / step;
                const ColumnDecimation decimation{width,   stride, step, 3 - static_cast<std::ptrdiff_t>(taps),
                                                  weights, phases};
                std::vector<Complex> fast(count * 41), plain(count * 41);
                decimated_columns(&tile[1], decimation, fast.data(), 41, count);
                decimated_columns_plain(&tile[1], decimation, plain.data(), 41, count);
                for (std::size_t i = 0; i < fast.size(); ++i)
                    ASSERT_LT(std::abs(fast[i] - plain[i]), 2e-5f) << step << ' ' << taps << ' ' << width << ' ' << i;
            }
        }
}

// Paths of hundreds of thousands of wavelengths.
TEST_P(NarrowBandKernels, vector_and_plain_phases_agree) {
    for (std::size_t count = 0; count <= 70; ++count) {
        const PathPhases paths{-0.02, 1.6e-6 * static_cast<double>(count), 0.09, 532e-9, 1234.56};
        std::vector<Complex> fast(count), plain(count);
        path_phases(paths, fast);
        path_phases_plain(paths, plain);
        for (std::size_t i = 0; i < count; ++i) EXPECT_LT(std::abs(fast[i] - plain[i]), 1e-6f) << count << ' ' << i;
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

}  // namespace
}  // namespace hogel::camera::narrow_band
