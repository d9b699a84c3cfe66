// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/hogel_tiles.h"

#include <gtest/gtest.h>

#include <random>

#include "hogel/core/test_targets.h"
#include "hogel/stereogram/designed_phase.h"
#include "hogel/stereogram/fast_tiles.h"

namespace hogel::stereogram {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(RandomWaves);
HOGEL_TEST_ON_EVERY_TARGET(TransposeKernels);
HOGEL_TEST_ON_EVERY_TARGET(FastTileKernels);

using Complex = std::complex<float>;

Array<float, 1> noise(std::size_t count, unsigned seed) {
    Array<float, 1> values({count});
    std::mt19937 random(seed);
    for (float& value : values.elements()) value = static_cast<float>(random() % 1000) / 1000;
    return values;
}

TEST_P(RandomWaves, equal_their_plain_version_and_take_the_bytes_of_their_rows) {
    const PhaseSeries series{{0xdeadbeefu, 7}, {5, 0xffffffffu, 13}};
    for (const std::size_t columns : {16, 64}) {
        const Array<float, 1> moduli = noise(columns * rows_at_once, 1);
        Array<float, 1> plain({columns * square_column}), fast({columns * square_column});
        random_waves_plain(series, 32, moduli.data(), columns, plain.data());
        random_waves(series, 32, moduli.data(), columns, fast.data());
        for (std::size_t i = 0; i < plain.size(); ++i)
            ASSERT_NEAR(plain.data()[i], fast.data()[i], 4e-7f) << columns << " " << i;
        // Element 40 · columns + 3 of the whole square is in row 8 of these sixteen.
        const std::vector<float> ones(41 * columns, 1.0f);
        std::vector<Complex> all(ones.size());
        spread_random_phases(series, ones, all);
        const Complex expected = all[40 * columns + 3] * moduli.data()[3 * rows_at_once + 8];
        EXPECT_NEAR(plain.data()[3 * square_column + 8], expected.real(), 1e-6f);
        EXPECT_NEAR(plain.data()[3 * square_column + rows_at_once + 8], expected.imag(), 1e-6f);
    }
}

TEST_P(TransposeKernels, puts_every_number_in_its_place) {
    constexpr std::size_t columns = 32;
    const Array<float, 1> rows = noise(columns * square_column, 2);
    Array<float, 1> transposed({2 * 600});
    transpose_rows(rows.data(), columns, transposed.data(), 600);
    for (std::size_t x = 0; x < columns; ++x)
        for (std::size_t part = 0; part < 2; ++part)
            for (std::size_t row = 0; row < 16; ++row)
                ASSERT_EQ(transposed.data()[x / 16 * 600 + row * 32 + part * 16 + x % 16],
                          rows.data()[x * 32 + part * 16 + row]);
    for (const std::size_t hogels : {1, 7, 16}) {
        const Array<float, 1> sixteen = noise(16 * columns * 16, 3);
        Array<float, 1> apart({17 * 700}), expected({17 * 700});
        transpose_hogels(sixteen.data(), columns, hogels, apart.data(), 700);
        for (std::size_t h = 0; h < hogels; ++h)
            for (std::size_t x = 0; x < columns; ++x)
                for (std::size_t row = 0; row < 16; ++row)
                    expected.data()[h * 700 + x * 16 + row] = sixteen.data()[(row * columns + x) * 16 + h];
        EXPECT_TRUE(std::ranges::equal(apart.elements(), expected.elements())) << hogels;
    }
}

// The plain version: all amplitudes, a phase for each, and one FFT.
TEST_P(FastTileKernels, equal_one_fft_of_amplitudes_with_phases) {
    for (const std::size_t side : {16, 32, 128}) {
        if (!FastTiles::can(side)) return;  // targets without vectors use the plain version
        // Fields of view that leave rows dark, including blocks of sixteen.
        const double tangent = side == 128 ? 0.02 : 0.06;
        const LightFieldGrid grid{1, 1, static_cast<double>(side) * 2e-6, 21, 19, Perspective{tangent, tangent}, 1};
        const FrequencyGrid frequencies(grid, side, 532e-9);
        constexpr std::size_t hogels = 19;
        Array<float, 2> rays({hogels, grid.directions()}), moduli({hogels, side * side}), blocks({hogels, side * side});
        std::ranges::copy(noise(rays.size(), 4).elements(), rays.data());
        frequencies.amplitudes(rays, moduli);
        const PhaseSeries series{{3, 4}, {5, 6, 7}};
        const math::Fft2 fft(side, side);
        DirectionPhases shared;
        for (const bool random : {true, false}) {
            Array<Complex, 2> phases({side, side});
            spread_random_phases(series, std::vector<float>(phases.size(), 1.0f), phases.elements());
            if (!random) shared = {Array<Complex, 2>({side, side}), phases};
            const FastTiles squares(side, shared);
            squares.prepare(frequencies, rays, false, blocks);
            for (const std::size_t h : {std::size_t{0}, std::size_t{18}}) {
                Array<Complex, 2> expected({side, side}), to({side, side + 8});
                for (std::size_t i = 0; i < expected.size(); ++i) expected.data()[i] = moduli(h, i) * phases.data()[i];
                fft.backward(expected);
                squares.synthesise(blocks[h].elements(), series, 1, to.data(), side + 8);
                float worst = 0, largest = 0;
                for (std::size_t y = 0; y < side; ++y)
                    for (std::size_t x = 0; x < side; ++x) {
                        worst = std::max(worst, std::abs(expected(y, x) - to(y, x)));
                        largest = std::max(largest, std::abs(expected(y, x)));
                    }
                EXPECT_LT(worst, 1e-6f * largest) << side << " " << random << " " << h;
                EXPECT_EQ(to(0, side), Complex(0)) << "writes nothing beside the square";
            }
        }
    }
}

}  // namespace
}  // namespace hogel::stereogram
