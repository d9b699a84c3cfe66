// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/packed_band.h"

#include <gtest/gtest.h>

#include <random>

namespace hogel::camera {
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
    // Zero beyond the last column and the last row.
    EXPECT_EQ(band.at(20, 36)[PackedBand::side - 36 % PackedBand::side - 1], math::PackedComplex());
    EXPECT_EQ(*band.at(21, 0), math::PackedComplex());
}

TEST(PackedBand, shares_memory_with_others_and_no_numbers) {
    std::vector<PackedBand> bands = PackedBand::dark(3, 20, 40);
    const PackedBand alone(20, 40);
    const math::PackedComplex one = math::pack({1, -1});
    for (std::size_t row = 0; row < 20; ++row)
        for (std::size_t column = 0; column < 40; ++column) *bands[1].at(row, column) = one;
    EXPECT_EQ(bands[0], alone);
    EXPECT_EQ(bands[2], alone);
    // The memory stays allocated while any of the bands exists.
    const PackedBand last = std::move(bands[1]);
    bands.clear();
    for (std::size_t row = 0; row < 20; ++row)
        for (std::size_t column = 0; column < 40; ++column) EXPECT_EQ(*last.at(row, column), one);
}

TEST(PackedBand, knows_its_dark_rows) {
    PackedBand band(20, 40);
    *band.at(18, 39) = math::pack({0, 1e-20f});
    for (std::size_t row = 0; row < 20; ++row) EXPECT_EQ(band.is_active(row), row == 18);
}

}  // namespace
}  // namespace hogel::camera
