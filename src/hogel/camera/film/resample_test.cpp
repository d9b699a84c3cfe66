// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/resample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "hogel/array.h"
#include "hogel/core/test_targets.h"

namespace hogel::camera::film {
namespace {

using namespace optics;

HOGEL_TEST_ON_EVERY_TARGET(FilmResample);

constexpr std::size_t both = 2 * block_lines;

// Waves are preserved up to the edge of the passband, and their images are stopped.
TEST_P(FilmResample, keeps_what_it_passes) {
    const InterpolationTable table;
    constexpr std::size_t size = 60, count = 300;
    for (const double frequency : {0.0, 0.1, 0.25, InterpolationTable::pass}) {
        const auto wave = [&](double at) {
            return std::polar(1.0f, static_cast<float>(6.283185307179586 * frequency * at));
        };
        Array<float, 1> lines({size * both}), values({count * both});
        for (std::size_t i = 0; i < size; ++i)
            for (std::size_t line = 0; line < block_lines; ++line) {
                lines(i * both + line) = wave(double(i)).real();
                lines(i * both + block_lines + line) = wave(double(i)).imag();
            }
        // Positions 20 … 40, nearly uniform.
        TangentPositions positions{-0.01, 0.02 / static_cast<double>(count), 30, {}, {}};
        positions.squares.fill(1);
        for (std::size_t line = 0; line < block_lines; ++line) positions.scales[line] = 1000 + double(line);
        resample_lines(lines.data(), size, positions, table, count, values.data());
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t line = 0; line < block_lines; ++line) {
                const double s = positions.first + static_cast<double>(i) * positions.step;
                const std::complex<float> value(values(i * both + line), values(i * both + block_lines + line)),
                    expected = wave(30 + positions.scales[line] * s / std::sqrt(1 - s * s));
                EXPECT_LT(std::abs(value - expected), 2e-3f) << frequency;
            }
    }
}

// Positions inside, at both ends and outside, forwards and backwards, of lines that are equal, that share weights
// through two, three and five nodes, and that do not.
TEST_P(FilmResample, vector_and_plain_agree) {
    const InterpolationTable table;
    constexpr std::size_t size = 90;
    Array<float, 1> lines({size * both});
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (float& value : lines.elements()) value = uniform(random);
    for (const double scale : {55.0, -70.0})
        for (const double change : {0.0, 3e-5, 2e-4, 8e-4, 5e-2})
            for (const bool by_square : {false, true})
                for (const std::size_t count : {0, 1, 2, 63, 64, 65, 150}) {
                    TangentPositions positions{-0.8, 1.6 / static_cast<double>(count + 1), 44.3, {}, {}};
                    positions.squares.fill(1.2);
                    positions.scales.fill(scale);
                    for (std::size_t line = 0; line < block_lines; ++line)
                        (by_square ? positions.squares : positions.scales)[line] *=
                            1 + change * double(line * 5 % 16 + line);
                    Array<float, 1> fast({(count + 1) * both}), plain({(count + 1) * both});
                    resample_lines(lines.data(), size, positions, table, count, fast.data());
                    resample_lines_plain(lines.data(), size, positions, table, count, plain.data());
                    // Phases of the table are rounded at the nodes instead of at each line.
                    for (std::size_t i = 0; i < fast.size(); ++i)
                        ASSERT_NEAR(fast(i), plain(i), change == 0 ? 1e-5 : 6e-3)
                            << scale << " " << change << " " << by_square << " " << count << " " << i;
                }
}

}  // namespace
}  // namespace hogel::camera::film
