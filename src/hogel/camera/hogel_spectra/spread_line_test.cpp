// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/spread_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "hogel/core/test_targets.h"

namespace hogel::camera::hogel_spectra {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(SpreadLine);

using Complex = std::complex<float>;

void fill_with_noise(std::span<float> values, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    for (float& value : values) value = normal(random);
}

TEST_P(SpreadLine, are_spread_down_as_plainly) {
    for (const auto& [samples, per_hogel, half_band] : std::vector<std::tuple<std::size_t, std::size_t, double>>{
             {16, 1, 0.2}, {32, 5, 1.1}, {27, 4, 0.9}, {64, 24, 5.2}}) {
        const SlepianBasis basis(samples, per_hogel, half_band);
        const std::size_t columns = 48, row = columns + lanes;
        Array<float, 3> line({basis.functions(), 2, row}), fast({basis.nodes(), 2, row}, 1.0f);
        fill_with_noise(line.elements(), 3);
        Array<float, 3> plain = fast;
        const float* carrier = basis.weights(2.5).carrier;
        spread_line(basis, carrier, &line(0, 0, lanes), row, columns, &fast(0, 0, lanes));
        spread_line_plain(basis, carrier, &line(0, 0, lanes), row, columns, &plain(0, 0, lanes));
        float largest = 0;
        for (const float value : plain.elements()) largest = std::max(largest, std::abs(value - 1));
        EXPECT_GT(largest, 0.1f);
        for (std::size_t i = 0; i < fast.size(); ++i)
            ASSERT_NEAR(fast.data()[i], plain.data()[i], 1e-5f * (1 + largest)) << samples << " " << i;
    }
}

// Light of single and of interleaved looks is added to bands, to the given columns only.
TEST_P(SpreadLine, are_demodulated_as_plainly) {
    constexpr std::size_t square = camera::PackedBand::square;
    const auto apart = [](math::PackedComplex a, math::PackedComplex b) {
        return std::abs(math::unpacked(a) - math::unpacked(b));
    };
    const math::PackedComplex one = math::pack(1);
    for (const std::size_t columns : {std::size_t{5}, std::size_t{16}, std::size_t{43}})
        for (const std::size_t looks : {std::size_t{16}, std::size_t{11}}) {
            const std::size_t row = padded(columns), size = row / lanes * square;
            Array<float, 2> phases({2, row}), light({2, row * lanes});
            fill_with_noise(phases.elements(), 1);
            fill_with_noise(light.elements(), 2);
            Array<math::PackedComplex, 2> fast({looks, size}, one), plain = fast, one_by_one = fast;
            std::vector<math::PackedComplex*> fast_rows, plain_rows;
            for (std::size_t look = 0; look < looks; ++look) {
                fast_rows.push_back(&fast(look, 0));
                plain_rows.push_back(&plain(look, 0));
                Array<float, 2> own({2, row});
                for (std::size_t part = 0; part < 2; ++part)
                    for (std::size_t x = 0; x < columns; ++x) own(part, x) = light(part, x * lanes + look);
                const LightRow single{own.data(), row, phases.data(), row};
                add_demodulated(single, columns, &one_by_one(look, 0));
                std::vector<math::PackedComplex> expected(size, one);
                add_demodulated_plain(single, columns, expected.data());
                for (std::size_t i = 0; i < size; ++i)
                    ASSERT_LT(apart(one_by_one(look, i), expected[i]), 0.01f) << columns << " " << i;
            }
            const LightRow side_by_side{light.data(), row * lanes, phases.data(), row};
            add_demodulated_looks(side_by_side, columns, fast_rows);
            add_demodulated_looks_plain(side_by_side, columns, plain_rows);
            for (std::size_t i = 0; i < fast.size(); ++i) {
                // A look does not depend on the other looks.
                ASSERT_EQ(fast.data()[i], one_by_one.data()[i]) << columns << " " << i;
                ASSERT_LT(apart(fast.data()[i], plain.data()[i]), 0.01f) << columns << " " << i;
            }
            for (std::size_t look = 0; look < looks; ++look)
                for (std::size_t i = 0; i < size; ++i)
                    EXPECT_EQ(fast(look, i) != one, i % square < lanes && i / square * lanes + i % square < columns)
                        << i;
        }
}

}  // namespace
}  // namespace hogel::camera::hogel_spectra
