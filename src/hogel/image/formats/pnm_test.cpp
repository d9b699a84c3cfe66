// SPDX-License-Identifier: Apache-2.0
// Portable pixmaps and float maps: the bytes of their specifications, every truncated length, and round trips.
#include <gtest/gtest.h>

#include <string>

#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/image/formats/formats.h"
#include "hogel/image/picture_bytes.h"

namespace hogel::image {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes bytes_of(const std::string& header, std::initializer_list<int> samples) {
    Bytes bytes(header.begin(), header.end());
    for (const int sample : samples) bytes.push_back(static_cast<unsigned char>(sample));
    return bytes;
}

Picture read(const Bytes& bytes) {
    const PictureReader reader = picture_reader(bytes);
    EXPECT_NE(reader, nullptr);
    return reader({bytes, "a", 1000});
}

TEST(PnmFiles, CodesAreThoseOfTheSpecification) {
    const auto eight =
        std::get<Array<std::uint8_t, 3>>(read(bytes_of("P6 2 1 # two\n255\n", {1, 2, 3, 4, 5, 255})).samples);
    EXPECT_EQ(eight.shape(), (Shape<3>{1, 2, 3}));
    EXPECT_EQ(eight(0, 1, 2), 255);
    EXPECT_EQ(eight(0, 1, 0), 4);
    // Ten bits in sixteen, high byte first.
    const Picture ten = read(bytes_of("P5\n2 1\n1023\n", {0x03, 0xff, 0x02, 0x01}));
    const auto& codes = std::get<Array<std::uint16_t, 3>>(ten.samples);
    EXPECT_EQ(ten.max_code, 1023u);
    EXPECT_EQ(codes(0, 0, 0), 65535);
    EXPECT_EQ(codes(0, 1, 0), 32864);  // 513/1023 of 65535 is 32863.6
}

TEST(PnmFiles, FloatMapsRunFromTheBottomUp) {
    const auto big = std::get<Array<float, 3>>(read(bytes_of("Pf\n1 2\n1.0\n", {63, 128, 0, 0, 64, 0, 0, 0})).samples);
    EXPECT_EQ(big(0, 0, 0), 2.0f);
    EXPECT_EQ(big(1, 0, 0), 1.0f);
    const auto little =
        std::get<Array<float, 3>>(read(bytes_of("Pf\n1 2\n-1\n", {0, 0, 128, 63, 0, 0, 0, 64})).samples);
    EXPECT_EQ(little(0, 0, 0), 2.0f);
}

TEST(PnmFiles, WhatIsWrittenIsReadBack) {
    Array<std::uint16_t, 3> codes({3, 2, 3});
    for (std::size_t i = 0; i < codes.size(); ++i) codes.data()[i] = static_cast<std::uint16_t>(i * 60);
    for (const std::uint32_t max : {1023u, 4095u, 65535u}) {
        const auto read_back = std::get<Array<std::uint16_t, 3>>(read(pnm_file(codes, max)).samples);
        for (std::size_t i = 0; i < codes.size(); ++i)
            EXPECT_EQ((read_back.data()[i] * max + 32767u) / 65535u, codes.data()[i]) << max;
    }
    Array<float, 3> values({3, 2, 3});
    for (std::size_t i = 0; i < values.size(); ++i) values.data()[i] = 0.3f * static_cast<float>(i) - 1;
    const auto floats = std::get<Array<float, 3>>(read(pfm_file(values)).samples);
    EXPECT_TRUE(std::ranges::equal(floats.elements(), values.elements()));
}

TEST(PnmFiles, DamageIsRefused) {
    for (const Bytes& whole :
         {bytes_of("P6 2 1 255\n", {1, 2, 3, 4, 5, 255}), bytes_of("Pf 1 1 -1\n", {0, 0, 128, 63})})
        for (std::size_t length = 2; length < whole.size(); ++length)
            EXPECT_THROW(read(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))), Error)
                << length;
    for (const char* header : {"P6 0 1 255\n", "P6 2 1 0\n", "P6 2 1 70000\n", "P6 2 x 255\n", "P6 2 99999999999 255\n",
                               "P6 2 1 nan\n", "P3 2 1 255\n", "PF 2 1 0\n", "PF 2 1 inf\n"})
        EXPECT_THROW(read(bytes_of(header, {1, 2, 3, 4, 5, 6})), Error) << header;
    EXPECT_THROW(read(bytes_of("P5 1 1 100\n", {101})), Error);  // a code beyond the largest
}

}  // namespace
}  // namespace hogel::image
