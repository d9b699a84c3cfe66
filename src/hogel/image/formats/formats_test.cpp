// SPDX-License-Identifier: Apache-2.0
// Reads files of other programs and damaged files.
#include "hogel/image/formats/formats.h"

#include <gtest/gtest.h>

#include <cstdio>  // before jpeglib.h, which needs FILE

#include <jpeglib.h>

#include <png.h>

#include <cstdlib>
#include <cstring>
#include <functional>
#include <numeric>
#include <stop_token>

#include "hogel/core/stop_scope.h"
#include "hogel/core/test_errors.h"
#include "hogel/error.h"
#include "hogel/image.h"

namespace hogel::image {
namespace {

using Bytes = std::vector<unsigned char>;

Array<std::uint8_t, 3> some_levels(std::size_t height, std::size_t width, std::size_t channels) {
    Array<std::uint8_t, 3> levels({height, width, channels});
    for (std::size_t i = 0; i < levels.size(); ++i) levels.data()[i] = static_cast<std::uint8_t>(i * 37 + i / 11);
    return levels;
}

// A PNG file of rows as PNG stores them (samples of 16 bits with the high byte first).
Bytes png_of(int type, int depth, int interlace, std::size_t width, const std::vector<Bytes>& rows,
             const std::vector<png_color>& palette = {}, const Bytes& palette_alpha = {}) {
    Bytes bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    const auto put = [](png_structp file, png_bytep from, std::size_t size) {
        auto* into = static_cast<Bytes*>(png_get_io_ptr(file));
        into->insert(into->end(), from, from + size);
    };
    png_set_write_fn(png, &bytes, put, nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(rows.size()), depth, type,
                 interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (!palette.empty()) png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    if (!palette_alpha.empty())
        png_set_tRNS(png, info, palette_alpha.data(), static_cast<int>(palette_alpha.size()), nullptr);
    png_write_info(png, info);
    const int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; ++pass)
        for (const Bytes& row : rows) png_write_row(png, row.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

Bytes jpeg_of(View<const std::uint8_t, 3> levels, int quality = 95) {
    jpeg_compress_struct jpeg;
    jpeg_error_mgr errors;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* memory = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &memory, &size);
    jpeg.image_width = static_cast<JDIMENSION>(levels.extent(1));
    jpeg.image_height = static_cast<JDIMENSION>(levels.extent(0));
    jpeg.input_components = static_cast<int>(levels.extent(2));
    jpeg.in_color_space = levels.extent(2) == 1 ? JCS_GRAYSCALE : levels.extent(2) == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, quality, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    const std::string comment = "a comment";
    jpeg_write_marker(&jpeg, JPEG_COM, reinterpret_cast<const JOCTET*>(comment.data()), 9);
    for (std::size_t y = 0; y < levels.extent(0); ++y) {
        auto* row = const_cast<JSAMPLE*>(levels[y].data());
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    Bytes bytes(memory, memory + size);
    std::free(memory);
    return bytes;
}

// An uncompressed Targa file: 18 bytes, then rows from the bottom up, blue, green, red.
Bytes tga_of(View<const std::uint8_t, 3> levels) {
    const std::size_t height = levels.extent(0), width = levels.extent(1), channels = levels.extent(2);
    Bytes bytes(18);
    bytes[2] = channels == 1 ? 3 : 2;
    bytes[12] = static_cast<unsigned char>(width);
    bytes[14] = static_cast<unsigned char>(height);
    bytes[16] = static_cast<unsigned char>(8 * channels);
    for (std::size_t y = height; y-- > 0;)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t c = channels; c-- > 0;) bytes.push_back(levels(y, x, c));
    return bytes;
}

// A Radiance file of width x height pixels with the value (0.5, 1, 2), without run lengths.
Bytes hdr_of(std::size_t width, std::size_t height) {
    const std::string header =
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
    Bytes bytes(header.begin(), header.end());
    for (std::size_t i = 0; i < width * height; ++i)
        for (const unsigned char value : {32, 64, 128, 130}) bytes.push_back(value);
    return bytes;
}

// A Radiance file of 8 x 2 pixels, in which each row is a run of one value for each byte of a pixel.
Bytes hdr_of_runs() {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n";
    Bytes bytes(header.begin(), header.end());
    for (int y = 0; y < 2; ++y)
        for (const unsigned char value : {2, 2, 0, 8, 136, 32, 136, 64, 136, 128, 136, 130}) bytes.push_back(value);
    return bytes;
}

// A GIF of one pixel with the first of two colours, (10, 20, 30).
Bytes small_gif() {
    return {'G', 'I', 'F', '8', '9', 'a', 1, 0, 1, 0, 0x80, 0, 0, 10,   20, 30, 0,  0,
            0,   ',', 0,   0,   0,   0,   1, 0, 1, 0, 0,    2, 2, 0x44, 1,  0,  ';'};
}

PictureBytes request(const Bytes& bytes, bool only_texts = false) { return {bytes, "a picture", 1 << 20, only_texts}; }

template <class T>
void expect_samples(const Picture& picture, View<const T, 3> expected, int tolerance = 0) {
    const auto* samples = std::get_if<Array<T, 3>>(&picture.samples);
    ASSERT_NE(samples, nullptr);
    ASSERT_EQ(samples->shape(), expected.shape());
    for (std::size_t i = 0; i < expected.size(); ++i)
        ASSERT_NEAR(samples->data()[i], expected.data()[i], tolerance) << i;
}

TEST(Pictures, are_neither_read_nor_written_to_the_end_when_a_stop_is_requested) {
    const Array<std::uint8_t, 3> grey({4, 3, 1});
    const Array<float, 3> light({4, 3, 3});
    const Bytes png = png_file(grey.view(), {}, Curve::srgb), jpeg = jpeg_file(grey, 90), exr = exr_file(light, {});
    const std::vector<std::function<void()>> works{[&] { png_file(grey.view(), {}, Curve::srgb); },
                                                   [&] { jpeg_file(grey, 90); },
                                                   [&] { exr_file(light, {}); },
                                                   [&] { read_png(request(png)); },
                                                   [&] { read_jpeg(request(jpeg)); },
                                                   [&] { read_exr(request(exr)); }};
    for (std::size_t i = 0; i < works.size(); ++i) {
        std::stop_source stop;
        const core::StopScope scope{Progress(stop.get_token())};
        EXPECT_FALSE(core::is_cancelled(works[i])) << i;
        stop.request_stop();
        EXPECT_TRUE(core::is_cancelled(works[i])) << i;
    }
}

TEST(PngReader, reads_interlaced_and_palette_and_narrow_pictures) {
    const Array<std::uint8_t, 3> levels = some_levels(9, 13, 3);
    std::vector<Bytes> rows;
    for (std::size_t y = 0; y < 9; ++y) rows.emplace_back(levels[y].elements().begin(), levels[y].elements().end());
    for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7})
        expect_samples<std::uint8_t>(read_png(request(png_of(PNG_COLOR_TYPE_RGB, 8, interlace, 13, rows))), levels);
    // Two pixels a byte, whose colours have alpha, which is dropped.
    const std::vector<png_color> palette{{1, 2, 3}, {250, 40, 7}, {9, 9, 9}};
    Array<std::uint8_t, 3> colours({1, 4, 3});
    const std::uint8_t expected[] = {9, 9, 9, 250, 40, 7, 1, 2, 3, 250, 40, 7};
    std::ranges::copy(expected, colours.data());
    expect_samples<std::uint8_t>(
        read_png(request(png_of(PNG_COLOR_TYPE_PALETTE, 4, 0, 4, {{0x21, 0x01}}, palette, {0, 128, 255}))), colours);
    Array<std::uint8_t, 3> bits({1, 8, 1});
    const std::uint8_t black_and_white[] = {255, 0, 255, 0, 0, 0, 255, 255};
    std::ranges::copy(black_and_white, bits.data());
    expect_samples<std::uint8_t>(read_png(request(png_of(PNG_COLOR_TYPE_GRAY, 1, 0, 8, {{0xa3}}))), bits);
}

TEST(PngReader, keeps_alpha_where_it_is_asked_for) {
    const auto read = [](const Bytes& bytes) {
        PictureBytes file = request(bytes);
        file.with_alpha = true;
        return read_png(file);
    };
    Array<std::uint16_t, 3> grey({1, 1, 4});
    std::ranges::fill_n(grey.data(), 3, std::uint16_t{0x1234});
    grey(0, 0, 3) = 0x0506;
    expect_samples<std::uint16_t>(read(png_of(PNG_COLOR_TYPE_GRAY_ALPHA, 16, 0, 1, {{0x12, 0x34, 5, 6}})), grey);
    const std::vector<png_color> palette{{1, 2, 3}, {250, 40, 7}, {9, 9, 9}};
    Array<std::uint8_t, 3> colours({1, 2, 4});
    const std::uint8_t expected[] = {9, 9, 9, 255, 250, 40, 7, 128};
    std::ranges::copy(expected, colours.data());
    expect_samples<std::uint8_t>(read(png_of(PNG_COLOR_TYPE_PALETTE, 4, 0, 2, {{0x21}}, palette, {0, 128})), colours);
    Array<std::uint8_t, 3> opaque({1, 1, 3});  // nothing to keep
    std::ranges::copy(std::array<std::uint8_t, 3>{250, 40, 7}, opaque.data());
    expect_samples<std::uint8_t>(read(png_of(PNG_COLOR_TYPE_PALETTE, 4, 0, 1, {{0x10}}, palette)), opaque);
}

TEST(PngReader, reads_16_bits_exactly_and_drops_alpha) {
    // Two grey pixels with alpha and one of colours with alpha.
    Array<std::uint16_t, 3> grey({1, 2, 1});
    grey(0, 0, 0) = 0x1234;
    grey(0, 1, 0) = 0xfffe;
    const Bytes with_alpha = png_of(PNG_COLOR_TYPE_GRAY_ALPHA, 16, 0, 2, {{0x12, 0x34, 0, 1, 0xff, 0xfe, 0, 0}});
    expect_samples<std::uint16_t>(read_png(request(with_alpha)), grey);
    Array<std::uint16_t, 3> colour({1, 1, 3});
    colour(0, 0, 0) = 1;
    colour(0, 0, 1) = 256;
    colour(0, 0, 2) = 65535;
    const Bytes rgba = png_of(PNG_COLOR_TYPE_RGB_ALPHA, 16, PNG_INTERLACE_ADAM7, 1, {{0, 1, 1, 0, 255, 255, 0, 7}});
    expect_samples<std::uint16_t>(read_png(request(rgba)), colour);
}

TEST(JpegReader, reads_grey_colours_inks_and_the_comment) {
    Array<std::uint8_t, 3> smooth({16, 16, 3});
    for (std::size_t y = 0; y < 16; ++y)
        for (std::size_t x = 0; x < 16; ++x)
            for (std::size_t c = 0; c < 3; ++c) smooth(y, x, c) = static_cast<std::uint8_t>(100 + 4 * y + 2 * x);
    const Picture colours = read_jpeg(request(jpeg_of(smooth)));
    expect_samples<std::uint8_t>(colours, smooth, 3);
    EXPECT_EQ(colours.texts, (Metadata{{"ImageDescription", "a comment"}}));
    Array<std::uint8_t, 3> grey({16, 16, 1}, 77), inks({16, 16, 4}, 200), as_colours({16, 16, 3}, 157);
    expect_samples<std::uint8_t>(read_jpeg(request(jpeg_of(grey))), grey, 1);
    expect_samples<std::uint8_t>(read_jpeg(request(jpeg_of(inks))), as_colours, 1);  // 200 x 200 / 255
}

TEST(StbReader, reads_bmp_tga_gif_and_hdr) {
    const Array<std::uint8_t, 3> colours = some_levels(5, 7, 3), grey = some_levels(5, 7, 1);
    expect_samples<std::uint8_t>(read_with_stb(request(bmp_file(colours))), colours);
    expect_samples<std::uint8_t>(read_with_stb(request(bmp_file(grey))), grey);
    expect_samples<std::uint8_t>(read_with_stb(request(tga_of(colours))), colours);
    expect_samples<std::uint8_t>(read_with_stb(request(tga_of(grey))), grey);
    Array<std::uint8_t, 3> pixel({1, 1, 3});
    for (std::size_t c = 0; c < 3; ++c) pixel(0, 0, c) = static_cast<std::uint8_t>(10 * (c + 1));
    expect_samples<std::uint8_t>(read_with_stb(request(small_gif())), pixel);
    const Picture hdr = read_with_stb(request(hdr_of(3, 2)));
    const auto& values = std::get<Array<float, 3>>(hdr.samples);
    ASSERT_EQ(values.shape(), (Shape<3>{2, 3, 3}));
    EXPECT_EQ(values(1, 2, 0), 0.5f);
    EXPECT_EQ(values(1, 2, 1), 1);
    EXPECT_EQ(values(1, 2, 2), 2);
}

TEST(ExrFile, has_the_texts_and_the_half_floats) {
    Array<float, 3> values({3, 4, 3});
    std::iota(values.data(), values.data() + values.size(), -5.0f);
    const Metadata texts{{"command", "photo"}, {"compression", "zip"}, {"DateTime", "today"},
                         {"", "nothing"},      {"type", "of a kind"},  {"a: b", "with a colon"}};
    const Picture picture = read_exr(request(exr_file(values, texts)));
    expect_samples<float>(picture, values);
    // Names that OpenEXR has for its own properties are left out.
    EXPECT_EQ(picture.texts, (Metadata{{"a: b", "with a colon"}, {"DateTime", "today"}, {"command", "photo"}}));
}

TEST(ExrFile, has_floats_where_halves_would_be_infinite_or_coarse) {
    for (const float scale : {1e6f, 1e-7f}) {
        Array<float, 3> values({2, 2, 3});
        for (std::size_t i = 0; i < values.size(); ++i) values.data()[i] = scale / (1.0f + float(i));
        expect_samples<float>(read_exr(request(exr_file(values, {}))), values);
    }
    // A single bright value is enough; dark ones beside ordinary ones are not.
    Array<float, 3> mixed({1, 2, 1}, 0.1f);
    mixed(0, 0, 0) = 65505.0f;
    expect_samples<float>(read_exr(request(exr_file(mixed, {}))), mixed);
    mixed(0, 0, 0) = 1e-7f;
    const Picture coarse = read_exr(request(exr_file(mixed, {})));
    EXPECT_NE((std::get<Array<float, 3>>(coarse.samples)(0, 1, 0)), 0.1f);
}

struct Sample {
    std::string name;
    Bytes bytes;
};

std::vector<Sample> samples() {
    const Array<std::uint8_t, 3> levels = some_levels(6, 5, 3);
    Array<float, 3> values({6, 5, 3}, 0.5f);
    const Metadata texts{{"command", "photo"}};
    return {{"png", png_file(levels, texts, Curve::srgb)},
            {"exr", exr_file(values, texts)},
            {"jpeg", jpeg_of(levels)},
            {"bmp", bmp_file(levels)},
            {"bmp_grey", bmp_file(some_levels(6, 5, 1))},
            {"tga", tga_of(levels)},
            {"hdr", hdr_of(5, 6)},
            {"hdr_runs", hdr_of_runs()},
            {"gif", small_gif()}};
}

// Returns whether a file was read. Any result but success or one line of bad_input fails the test.
bool is_read(std::span<const unsigned char> bytes) {
    try {
        decode_image(bytes, "the file", 1 << 20);
        return true;
    } catch (const Error& error) {
        const std::string what = error.what();
        EXPECT_EQ(error.code(), ErrorCode::bad_input) << what;
        EXPECT_NE(what.find("'the file'"), std::string::npos) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        return false;
    }
}

TEST(DamagedPictures, cut_at_any_length_are_refused_in_one_line) {
    testing::internal::CaptureStderr();
    for (const Sample& sample : samples()) {
        ASSERT_TRUE(is_read(sample.bytes)) << sample.name;
        for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
            const bool read = is_read({sample.bytes.data(), length});
            // The last bytes may be padding, or an end mark after complete pixels.
            if (length + 4 < sample.bytes.size()) {
                EXPECT_FALSE(read) << sample.name << " of " << length << " bytes";
            }
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(DamagedPictures, with_any_byte_changed_are_read_or_refused_in_one_line) {
    testing::internal::CaptureStderr();
    for (const Sample& sample : samples())
        for (std::size_t offset = 0; offset < std::min<std::size_t>(sample.bytes.size(), 700); ++offset)
            for (const unsigned char value : {0x00, 0x01, 0x7f, 0xff}) {
                Bytes damaged = sample.bytes;
                damaged[offset] = value;
                is_read(damaged);
            }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace hogel::image
