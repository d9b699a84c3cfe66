// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/exact_coder.h"

#include <gtest/gtest.h>

#include <bit>

#include "hogel/codec/test_damage.h"
#include "hogel/codec/test_fields.h"
#include "hogel/compress.h"
#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::codec {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

CompressionOptions lossless() {
    CompressionOptions options;
    options.target = Lossless{};
    options.tile = HogelRange{0, 0, 4, 3};
    return options;
}

CompressionOptions bounded(double error) {
    CompressionOptions options;
    options.target = MaxError{error};
    options.tile = HogelRange{0, 0, 4, 3};
    return options;
}

LightFieldBuffer through(const LightFieldBuffer& field, const CompressionOptions& options,
                         CompressionResult* result = nullptr) {
    const TestFolder folder;
    const CompressionResult found = compress(field, folder / "a.hgl", options);
    if (result) *result = found;
    LightFieldBuffer decoded(field.grid());
    copy(open_stream(folder / "a.hgl").front(), decoded);
    return decoded;
}

void expect_same_bits(const LightFieldBuffer& a, const LightFieldBuffer& b) {
    for (std::size_t i = 0; i < a.radiance.size(); ++i)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(a.radiance.data()[i]),
                  std::bit_cast<std::uint32_t>(b.radiance.data()[i]))
            << i;
}

// Some samples are negative, not finite, subnormal or very large.
LightFieldBuffer with_odd_values(std::size_t channels) {
    LightFieldBuffer field = textured_planes(5, 4, 13, 11, channels);
    const float odd[] = {
        infinity, -infinity, std::bit_cast<float>(0x7FC12345u), std::bit_cast<float>(0xFF800001u),    -0.0f, 0.0f,
        1e-45f,   -1e-40f,   std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest(), -0.7f, 1e-30f};
    for (std::size_t i = 0; i < std::size(odd); ++i) field.radiance.data()[i * 97 + 5] = odd[i];
    return field;
}

// Returns the nearest float with a significand of ten bits, as half floats have.
float ten_bits(float value) { return std::bit_cast<float>((std::bit_cast<std::uint32_t>(value) + 0x1000u) & ~0x1FFFu); }

TEST(Lossless, every_bit_comes_back) {
    for (const std::size_t channels : {1, 3}) {
        const LightFieldBuffer field = with_odd_values(channels);
        CompressionResult result;
        expect_same_bits(field, through(field, lossless(), &result));
        EXPECT_EQ(result.sqnr, infinity);
        LightFieldBuffer rough = textured_planes(3, 5, 10, 9, channels);
        for (float& value : rough.radiance.elements()) value = ten_bits(value);
        expect_same_bits(rough, through(rough, lossless()));
    }
    const LightFieldBuffer dark(LightFieldGrid{4, 4, 1e-3, 8, 8, Perspective{0.3, 0.3}, 3});
    expect_same_bits(dark, through(dark, lossless()));
}

TEST(Lossless, random_bits_take_at_most_a_tenth_more) {
    LightFieldBuffer field = textured_planes(6, 6, 32, 24, 1);
    std::uint32_t k = 0;
    for (float& value : field.radiance.elements())
        value = std::bit_cast<float>(core::philox({k++, 7, 7, 7}, {1, 2})[0]);
    CompressionResult result;
    expect_same_bits(field, through(field, lossless(), &result));
    EXPECT_LT(double(result.bytes), 1.1 * 4 * 6 * 6 * 32 * 24);
}

// Prediction makes them shorter than 16 bits, and the other 16 bits of a float take none.
TEST(Lossless, half_floats_take_less_than_16_bits) {
    LightFieldBuffer field = textured_planes(8, 8, 32, 32, 1);
    for (float& value : field.radiance.elements()) value = ten_bits(value);
    CompressionResult result;
    through(field, lossless(), &result);
    EXPECT_GT(result.pixels_per_bit, 1 / 9.0);
}

TEST(Bounded, every_sample_is_within_the_bound) {
    const LightFieldBuffer field = with_odd_values(3);
    std::size_t bytes = std::numeric_limits<std::size_t>::max();
    for (const double error : {1e-9, 1e-6, 1e-3, 0.01, 0.2}) {
        CompressionResult result;
        const LightFieldBuffer decoded = through(field, bounded(error), &result);
        double largest = 0;
        for (std::size_t i = 0; i < field.radiance.size(); ++i) {
            const float truth = field.radiance.data()[i], found = decoded.radiance.data()[i];
            if (std::isfinite(truth))
                largest = std::max(largest, std::abs(double(truth) - found));
            else
                ASSERT_EQ(std::bit_cast<std::uint32_t>(truth), std::bit_cast<std::uint32_t>(found));
        }
        EXPECT_LE(largest, error);
        EXPECT_LE(result.bytes, bytes) << error;
        bytes = result.bytes;
    }
}

TEST(Bounded, returns_the_sqnr_that_decoding_gives) {
    const LightFieldBuffer field = textured_planes(6, 5, 20, 16, 1);
    CompressionResult result;
    const LightFieldBuffer decoded = through(field, bounded(0.01), &result);
    EXPECT_NEAR(sqnr_of(field, decoded), result.sqnr, 1e-6);
    EXPECT_GT(result.sqnr, 35);
}

TEST(Exact, bytes_do_not_depend_on_threads) {
    const TestFolder folder;
    const LightFieldBuffer field = with_odd_values(3);
    for (const CompressionOptions& options : {lossless(), bounded(0.01)}) {
        std::vector<std::vector<std::uint8_t>> files;
        for (const std::size_t threads : {1, 3}) {
            const ThreadLimit limit(threads);
            compress(field, folder / "a.hgl", options);
            files.push_back(bytes_of_file(folder / "a.hgl"));
        }
        EXPECT_EQ(files[0], files[1]);
    }
}

TEST(Exact, other_coders_are_refused) {
    const TestFolder folder;
    const LightFieldBuffer field = textured_planes(2, 2, 4, 4, 1);
    CompressionOptions options = lossless();
    options.method = {"ezw", "haar"};
    EXPECT_THROW(compress(field, folder / "a.hgl", options), Error);
    EXPECT_THROW(compress(field, folder / "a.hgl", bounded(-1)), Error);
}

// Large hogels have a code each, small ones a code per row.
TEST(Exact, any_range_has_the_samples_of_the_whole) {
    const TestFolder folder;
    for (const std::size_t directions : {std::size_t{16}, std::size_t{128}}) {
        const LightFieldBuffer field = textured_planes(5, 4, directions, directions, 1);
        compress(field, folder / "a.hgl", lossless());
        for (const HogelRange& range : {HogelRange{3, 2, 1, 1}, {1, 0, 3, 3}, {0, 3, 5, 1}, {4, 1, 1, 2}}) {
            const LightField source = open_stream(folder / "a.hgl");
            for (const HogelRange& next : {range, HogelRange{0, 0, 5, 4}}) {
                LightFieldTile tile(field.grid(), next, false), expected = tile;
                source.front().read(tile);
                field.read(expected);
                for (std::size_t k = 0; k < tile.radiance.size(); ++k)
                    ASSERT_EQ(tile.radiance.data()[k], expected.radiance.data()[k]) << directions;
            }
        }
    }
}

// Decoding gives a tile or throws Error(bad_input).
TEST(Exact, damaged_bytes_do_no_harm) {
    const LightFieldBuffer field = with_odd_values(1);
    LightFieldTile tile(field.grid(), {0, 0, 2, 1}, false);
    field.read(tile);
    const auto try_coder = [&](const TileCoder& coder) {
        expect_harmless_damage(coder, coder.encode(tile, 0.02).bytes, tile, 5, 2);
    };
    try_coder(*make_lossless_coder(field.grid(), {}));
    try_coder(*make_bounded_coder(field.grid(), {}, 0.01));
    // A hogel with a code of its own.
    LightFieldBuffer noise(LightFieldGrid{1, 1, 1e-3, 72, 64, Perspective{0.3, 0.3}, 1});
    std::uint32_t k = 0;
    for (float& value : noise.radiance.elements()) value = static_cast<float>(core::philox({k++, 7, 7, 7}, {1, 2})[0]);
    LightFieldTile one(noise.grid(), {0, 0, 1, 1}, false);
    noise.read(one);
    const auto coder = make_lossless_coder(noise.grid(), {});
    expect_harmless_damage(*coder, coder->encode(one, 1).bytes, one, 997, 499);
}

}  // namespace
}  // namespace hogel::codec
