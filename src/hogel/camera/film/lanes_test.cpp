// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "hogel/array.h"
#include "hogel/core/test_targets.h"

namespace hogel::camera::film {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(FilmLanes);

constexpr std::size_t row = math::SplitFft::row, together = math::SplitFft::together;

Array<float, 1> noise(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1);
    Array<float, 1> values({count});
    for (float& value : values.elements()) value = uniform(random);
    return values;
}

void expect_near(const Array<float, 1>& fast, const Array<float, 1>& plain) {
    for (std::size_t i = 0; i < fast.size(); ++i) ASSERT_NEAR(fast(i), plain(i), 1e-6) << i;
}

Array<math::PackedComplex, 1> packed_noise(std::size_t count, unsigned seed) {
    const Array<float, 1> parts = noise(2 * count, seed);
    Array<math::PackedComplex, 1> numbers({count});
    for (std::size_t i = 0; i < count; ++i) numbers(i) = math::pack({parts(2 * i), parts(2 * i + 1)});
    return numbers;
}

TEST_P(FilmLanes, vector_and_plain_packed_rows_agree) {
    const Array<float, 1> rows = noise(20 * row, 8);
    const std::vector<std::uint32_t> places{3, 19, 0, 7};
    Array<math::PackedComplex, 1> fast({4 * together}), plain({4 * together});
    pack_rows(rows.data(), places, fast.data());
    pack_rows_plain(rows.data(), places, plain.data());
    EXPECT_TRUE(std::ranges::equal(fast.elements(), plain.elements()));
    EXPECT_EQ(plain(together + 5), math::pack({rows(19 * row + 5), rows(19 * row + together + 5)}));
}

TEST_P(FilmLanes, vector_and_plain_products_agree) {
    const Array<math::PackedComplex, 1> wave = packed_noise(7 * together, 1);
    const Array<float, 1> lens = noise(7 * row, 2);
    Array<float, 1> fast({8 * row}), plain({8 * row});
    times_lens(wave.data(), lens.data(), 7, fast.data());
    times_lens_plain(wave.data(), lens.data(), 7, plain.data());
    expect_near(fast, plain);
    EXPECT_NE(plain(6 * row), 0);
}

// Numbers of indices and lanes that fill blocks, and that do not.
TEST_P(FilmLanes, vector_and_plain_turns_agree) {
    const Array<float, 1> rows = noise(40 * row, 3);
    for (const std::size_t count : {16, 35, 40})
        for (const std::size_t lanes : {1, 5, 16}) {
            std::vector<std::uint32_t> places;
            for (std::size_t i = 0; i < count; ++i) places.push_back(static_cast<std::uint32_t>(i * 7 % 40));
            const std::size_t block = 20 * row;
            Array<float, 1> fast({3 * block}), plain({3 * block});
            for (Array<float, 1>* some : {&fast, &plain}) some->elements()[lanes * row] = 5;  // beyond the lanes
            transpose_selected(rows.data(), places, lanes, fast.data(), block);
            transpose_selected_plain(rows.data(), places, lanes, plain.data(), block);
            expect_near(fast, plain);
            EXPECT_EQ(plain(lanes * row), 5);
            EXPECT_EQ(plain(block + (lanes - 1) * row + 2), count > 18 ? rows(places[18] * row + lanes - 1) : 0);
        }
}

TEST_P(FilmLanes, vector_and_plain_intensities_agree) {
    const Array<float, 1> rows = noise(30 * row, 4), across = noise(together, 5), down = noise(20, 6);
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < 20; ++i) places.push_back(i * 11 % 30);
    Array<float, 1> fast({20 * together}), plain({20 * together});
    for (Array<float, 1>* some : {&fast, &plain}) some->elements()[3] = 2;
    add_intensities(rows.data(), places, across.data(), down.elements(), fast.data());
    add_intensities_plain(rows.data(), places, across.data(), down.elements(), plain.data());
    expect_near(fast, plain);
    const float re = rows(11 * row + 1), im = rows(11 * row + 17);
    EXPECT_NEAR(plain(17), across(1) * down(1) * (re * re + im * im), 1e-6);
}

TEST_P(FilmLanes, vector_and_plain_rows_side_by_side_agree) {
    const Array<math::PackedComplex, 1> squares = packed_noise(3 * together * together, 7);
    Array<float, 1> fast({3 * together * row}), plain({3 * together * row});
    interleave_rows(squares.data(), 3, fast.data());
    interleave_rows_plain(squares.data(), 3, plain.data());
    expect_near(fast, plain);
    // Column 5 of row 2 of the second square.
    const std::complex<float> value = math::unpacked(squares(together * together + 2 * together + 5));
    EXPECT_EQ(plain((together + 5) * row + 2), value.real());
    EXPECT_EQ(plain((together + 5) * row + together + 2), value.imag());
}

TEST_P(FilmLanes, vector_and_plain_transposes_agree) {
    const Array<float, 1> rows = noise(640, 7);  // 16 rows of 40 values
    Array<float, 1> fast({384}), plain({384});   // 24 rows of 16 values
    transpose_block(rows.data(), 40, 24, fast.data());
    transpose_block_plain(rows.data(), 40, 24, plain.data());
    expect_near(fast, plain);
    EXPECT_EQ(plain(3 * 24 + 5), rows(5 * 40 + 3));
}

}  // namespace
}  // namespace hogel::camera::film
