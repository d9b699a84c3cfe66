// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/lens_stretch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "hogel/array.h"
#include "hogel/core/test_targets.h"

namespace hogel::camera::film {
namespace {

using namespace optics;

HOGEL_TEST_ON_EVERY_TARGET(FilmLensStretch);

constexpr std::size_t both_stretches = 2 * block_lines;
constexpr double radius = 3e-3, length = 32;

const PupilEdge& edge() {
    static const PupilEdge rim(SpreadWindow(0.05, 0.05, 0.002, 532e-9 / (2 * radius)), 532e-9);
    return rim;
}

// Rows that begin `left` metres beside the middle of the pupil, far enough apart that some are outside.
struct Rows {
    explicit Rows(double first) : left(first) {
        stretch.columns = 29;
        stretch.inner = radius - edge().reach();
        for (std::size_t row = 0; row < block_lines; ++row) {
            double squares[3], weights[3], phases[3];
            for (std::size_t i = 0; i < 3; ++i) {
                const double t = 0.5 * length * double(i);
                squares[i] = square(row, t);
                weights[i] = weight(row, t);
                phases[i] = cycles(row, t);
            }
            stretch.set(row, squares, weights, phases, length);
        }
    }
    double square(std::size_t row, double t) const {
        const double x = left + 40e-6 * t, y = 250e-6 * double(row) - 5e-4;
        return x * x + y * y;
    }
    double weight(std::size_t row, double t) const { return 1 + 0.01 * double(row) + 1e-3 * t + 1e-5 * t * t; }
    double cycles(std::size_t row, double t) const { return 800.3 + 7.1 * double(row) + 0.21 * t - 2e-3 * t * t; }

    double left;
    LensStretch stretch;
};

// Inside, across the rim, and outside.
TEST_P(FilmLensStretch, is_the_transmission_at_each_place) {
    for (const double left : {-0.4e-3, 1.9e-3, 4e-3}) {
        const Rows rows(left);
        Array<float, 1> fast({32 * both_stretches}), plain({32 * both_stretches});
        lens_stretch(rows.stretch, edge(), radius, fast.data());
        lens_stretch_plain(rows.stretch, edge(), radius, plain.data());
        for (std::size_t column = 0; column < rows.stretch.columns; ++column)
            for (std::size_t row = 0; row < block_lines; ++row) {
                const double t = double(column), distance = std::sqrt(rows.square(row, t));
                const std::complex<double> expected =
                    std::polar(rows.weight(row, t) * edge().transmission(radius - distance),
                               2 * std::numbers::pi * rows.cycles(row, t));
                const std::size_t at = column * both_stretches + row;
                ASSERT_NEAR(fast(at), expected.real(), 3e-4) << left << " " << column << " " << row;
                ASSERT_NEAR(fast(at + block_lines), expected.imag(), 3e-4) << left << " " << column << " " << row;
                ASSERT_NEAR(fast(at), plain(at), 1e-4) << left << " " << column << " " << row;
                ASSERT_NEAR(fast(at + block_lines), plain(at + block_lines), 1e-4) << left;
            }
        EXPECT_EQ(fast(rows.stretch.columns * both_stretches), 0) << left;  // nothing beyond the last column
    }
}

}  // namespace
}  // namespace hogel::camera::film
