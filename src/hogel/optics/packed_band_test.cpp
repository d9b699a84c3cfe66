// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/packed_band.h"

#include <gtest/gtest.h>

#include <random>

namespace hogel::optics {
namespace {

using Complex = std::complex<float>;

Array<Complex, 2> noise(std::size_t height, std::size_t width) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    Array<Complex, 2> numbers({height, width});
    for (Complex& number : numbers.elements()) number = {normal(random), normal(random)};
    return numbers;
}

TEST(PackedBand, holds_numbers_where_they_were) {
    const Array<Complex, 2> numbers = noise(21, 37);
    const PackedBand band(numbers);
    ASSERT_EQ(band.height(), 21u);
    ASSERT_EQ(band.width(), 37u);
    for (std::size_t row = 0; row < 21; ++row)
        for (std::size_t column = 0; column < 37; ++column)
            EXPECT_EQ(*band.at(row, column), math::pack(numbers(row, column))) << row << " " << column;
    // Beyond the last column and the last row it is dark.
    EXPECT_EQ(band.at(20, 36)[PackedBand::side - 36 % PackedBand::side - 1], math::PackedComplex());
    EXPECT_EQ(*band.at(21, 0), math::PackedComplex());
}

TEST(PackedBand, adds_a_part_in_its_place) {
    const Array<Complex, 2> whole = noise(40, 50), some = noise(5, 18);
    PackedBand sum(whole);
    sum.add(some, 17, 32);
    for (std::size_t row = 0; row < 40; ++row)
        for (std::size_t column = 0; column < 50; ++column) {
            math::PackedComplex expected = math::pack(whole(row, column));
            if (row >= 17 && row < 22 && column >= 32)
                expected = math::pack(math::unpacked(expected) + some(row - 17, column - 32));
            EXPECT_EQ(*sum.at(row, column), expected) << row << " " << column;
        }
}

TEST(PackedBand, knows_its_dark_rows) {
    PackedBand band(20, 40);
    band.add(Array<Complex, 2>({1, 1}, Complex(0, 1e-20f)), 18, 32);
    for (std::size_t row = 0; row < 20; ++row) EXPECT_EQ(band.is_lit(row), row == 18);
}

}  // namespace
}  // namespace hogel::optics
