// SPDX-License-Identifier: Apache-2.0
#include "hogel/image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "hogel/error.h"
#include "hogel/image/picture_formats.h"

namespace hogel::image {
namespace {

struct Storage {
    std::string format;
    std::size_t channels;
};

class RawPixelFiles : public testing::TestWithParam<Storage> {};

TEST_P(RawPixelFiles, are_read_back_as_they_were_written) {
    const auto& [format, channels] = GetParam();
    Array<std::uint8_t, 3> levels({7, 37, channels});
    for (std::size_t i = 0; i < levels.size(); ++i) levels.data()[i] = static_cast<std::uint8_t>(i * 151);
    const auto path = std::filesystem::path(testing::TempDir()) / ("levels" + std::to_string(channels) + "." + format);
    write_raw_pixels(path, levels, {{"encoding", "phase"}});
    const Image image = read_image(path);
    ASSERT_EQ(image.width(), 37u);
    ASSERT_EQ(image.height(), 7u);
    ASSERT_EQ(image.channels(), channels);
    // read_image() takes integers as sRGB.
    for (std::size_t y = 0; y < 7; ++y)
        for (std::size_t x = 0; x < 37; ++x)
            for (std::size_t c = 0; c < image.channels(); ++c)
                ASSERT_EQ(std::lround(255 * srgb_encode(image.pixels(y, x, c))), levels(y, x, c));
    std::filesystem::remove(path);
}

std::vector<Storage> storages() {
    std::vector<Storage> all;
    for (const PictureFormat& format : picture_formats())
        for (const std::size_t channels : {1, 3})
            if (format.written_as_levels) all.push_back({format.extensions.front().substr(1), channels});
    return all;
}

INSTANTIATE_TEST_SUITE_P(Formats, RawPixelFiles, testing::ValuesIn(storages()), [](const auto& test) {
    return test.param.format + "_" + std::to_string(test.param.channels) + "_channels";
});

TEST(RawPixelFile, of_16_bits_is_a_png_with_the_numbers_that_were_written) {
    for (const std::size_t channels : {1, 3}) {
        Array<std::uint16_t, 3> levels({7, 37, channels});
        for (std::size_t i = 0; i < levels.size(); ++i) levels.data()[i] = static_cast<std::uint16_t>(i * 40961);
        const auto path = std::filesystem::path(testing::TempDir()) / "deep.png";
        write_raw_pixels(path, levels);
        const RawChannels read = read_raw_channels(path);
        EXPECT_EQ(read.largest, 65535u);
        EXPECT_TRUE(std::ranges::equal(read.values.elements(), levels.elements()));
        std::filesystem::remove(path);
        EXPECT_THROW(write_raw_pixels("deep.bmp", levels), Error);
    }
    EXPECT_NO_THROW(require_raw_pixels_name("deep.png", 65536));
    EXPECT_THROW(require_raw_pixels_name("deep.bmp", 257), Error);
    EXPECT_NO_THROW(require_raw_pixels_name("flat.bmp", 256));
}

TEST(RawPixelFile, with_an_unknown_extension_or_in_no_directory_is_refused) {
    const Array<std::uint8_t, 3> levels({2, 2, 1});
    EXPECT_THROW(write_raw_pixels("pattern.exr", levels), Error);
    EXPECT_THROW(require_raw_pixels_name("pattern"), Error);
    EXPECT_THROW(write_raw_pixels("/nonexistent/pattern.bmp", levels), Error);
    EXPECT_THROW(write_raw_pixels("/nonexistent/pattern.png", levels), Error);
}

}  // namespace
}  // namespace hogel::image
