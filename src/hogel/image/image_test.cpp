// SPDX-License-Identifier: Apache-2.0
#include "hogel/image.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "hogel/error.h"
#include "hogel/image/picture_formats.h"

namespace hogel::image {
namespace {

namespace fs = std::filesystem;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

class ImageFile : public testing::Test {
  protected:
    ImageFile() { fs::create_directories(directory_); }
    ~ImageFile() override { fs::remove_all(directory_); }
    fs::path directory_ = fs::path(testing::TempDir()) / ("hogel_image_" + std::to_string(::getpid()));
};

// Returns file names of a picture, in each 8-bit format, and in each format that write_image() writes.
std::vector<std::string> names_of_8_bits() {
    if (format_by_extension("a.tif")->built_in) return {"a.png", "a.tif"};
    return {"a.png"};
}
std::vector<std::string> names() {
    std::vector<std::string> names = names_of_8_bits();
    names.push_back("a.exr");
    return names;
}

// Values that are exact as half floats.
Image ramp(std::size_t width, std::size_t height, std::size_t channels) {
    Image image(width, height, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels.data()[i] = static_cast<float>(i % 1024) / 512;
    return image;
}

std::vector<unsigned char> bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void save(const fs::path& path, const std::vector<unsigned char>& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

std::string refusal(const fs::path& path, std::size_t max_pixels = 1 << 20) {
    try {
        read_image(path, max_pixels);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "";
}

TEST(Srgb, has_the_published_values) {
    // Middle grey: 8-bit 188 is 50 % light and 119 is 18.4 %; the ends; the break of IEC 61966-2-1 at 0.0031308.
    EXPECT_NEAR(255 * srgb_encode(0.5f), 187.516, 1e-3);
    EXPECT_NEAR(srgb_decode(188.0f / 255), 0.502886, 1e-6);
    EXPECT_NEAR(srgb_decode(0.5f), 0.214041, 1e-6);
    EXPECT_NEAR(srgb_encode(0.0031308f), 0.0404499, 1e-6);
    EXPECT_NEAR(srgb_encode(0.001f), 0.01292, 1e-8);
    EXPECT_EQ(srgb_encode(1), 1);
    EXPECT_EQ(srgb_decode(1), 1);
    for (float outside : {-1.0f, -infinite, nan}) {
        EXPECT_EQ(srgb_encode(outside), 0);
        EXPECT_EQ(srgb_decode(outside), 0);
    }
    EXPECT_EQ(srgb_encode(infinite), 1);
    float last = -1;
    for (int i = 0; i <= 65535; ++i) {
        const float display = static_cast<float>(i) / 65535;
        EXPECT_NEAR(srgb_encode(srgb_decode(display)), display, 3e-6);
        EXPECT_GT(srgb_decode(display), last);
        last = srgb_decode(display);
    }
}

TEST_F(ImageFile, exr_keeps_linear_values_and_metadata) {
    for (std::size_t channels : {1, 3}) {
        const Image image = ramp(37, 23, channels);
        write_image(directory_ / "a.exr", image, 5, {{"hogel_command", "photo --eye 0,0,300mm"}, {"hogel_note", "ζ"}});
        const Image back = read_image(directory_ / "a.exr");
        ASSERT_EQ(back.pixels.shape(), image.pixels.shape());
        EXPECT_TRUE(std::ranges::equal(back.pixels.elements(), image.pixels.elements()));
        const Metadata metadata = read_metadata(directory_ / "a.exr");
        EXPECT_EQ(
            std::ranges::count(metadata, std::pair<std::string, std::string>{"hogel_command", "photo --eye 0,0,300mm"}),
            1);
        EXPECT_EQ(std::ranges::count(metadata, std::pair<std::string, std::string>{"hogel_note", "ζ"}), 1);
    }
}

TEST_F(ImageFile, of_8_bits_keeps_every_display_value) {
    // Each of the 256 display values is read back as the same linear light.
    for (const std::string& name : names_of_8_bits())
        for (std::size_t channels : {1, 3})
            for (double exposure : {1.0, 0.25}) {
                Image image(16, 16, channels);
                for (std::size_t i = 0; i < 256; ++i)
                    for (std::size_t c = 0; c < channels; ++c)
                        image.pixels(i / 16, i % 16, c) =
                            static_cast<float>(srgb_decode(static_cast<float>((i + 50 * c) % 256) / 255) / exposure);
                write_image(directory_ / name, image, exposure);
                const Image back = read_image(directory_ / name);
                ASSERT_EQ(back.pixels.shape(), image.pixels.shape());
                for (std::size_t i = 0; i < image.pixels.size(); ++i)
                    ASSERT_NEAR(back.pixels.data()[i], image.pixels.data()[i] * exposure, 1e-6) << name;
            }
}

TEST_F(ImageFile, of_8_bits_keeps_metadata) {
    const Metadata metadata{{"hogel_command", "render scene.glb --hogels 64x64"}, {"hogel_version", "1.2.3"}};
    for (const std::string& name : names_of_8_bits()) {
        write_image(directory_ / name, ramp(3, 2, 3), 1, metadata);
        EXPECT_EQ(read_metadata(directory_ / name), metadata) << name;
    }
}

TEST_F(ImageFile, values_beyond_display_are_clamped) {
    Image image(5, 1, 1);
    const float values[] = {-1, nan, 0, 7, infinite};
    std::ranges::copy(values, image.pixels.data());
    write_image(directory_ / "a.png", image);
    const Image back = read_image(directory_ / "a.png");
    const float expected[] = {0, 0, 0, 1, 1};
    EXPECT_TRUE(std::ranges::equal(back.pixels.elements(), expected));
}

TEST_F(ImageFile, pictures_in_memory_equal_those_in_files) {
    const Image image = ramp(19, 7, 3);
    const std::vector<unsigned char> png = encode_png(image, 0.5);
    write_image(directory_ / "a.png", image, 0.5);
    EXPECT_EQ(png, bytes_of(directory_ / "a.png"));
    for (const std::string& name : names()) {
        write_image(directory_ / name, image, 0.5);
        const Image from_file = read_image(directory_ / name);
        const Image from_memory = decode_image(bytes_of(directory_ / name), "no name");
        ASSERT_EQ(from_memory.pixels.shape(), from_file.pixels.shape());
        EXPECT_TRUE(std::ranges::equal(from_memory.pixels.elements(), from_file.pixels.elements())) << name;
    }
}

TEST_F(ImageFile, jpeg_in_memory_is_close_to_the_picture) {
    for (const std::size_t channels : {1u, 3u}) {
        const Image image = ramp(64, 48, channels);
        const std::vector<unsigned char> fine = encode_jpeg(image, 1, 95), coarse = encode_jpeg(image, 1, 40);
        const Image back = decode_image(fine, "fine");
        ASSERT_EQ(back.pixels.shape(), image.pixels.shape());
        EXPECT_GT(compare(image, back).psnr, 40) << channels;
        EXPECT_LT(coarse.size(), fine.size());
        EXPECT_LT(compare(image, decode_image(coarse, "coarse")).psnr, compare(image, back).psnr);
        Image twice = image;
        for (float& value : twice.pixels.elements()) value *= 0.5f;
        EXPECT_EQ(encode_jpeg(twice, 2, 95), fine);
    }
    EXPECT_THROW(encode_jpeg(ramp(4, 4, 3), 1, 0), Error);
    EXPECT_THROW(encode_jpeg(ramp(4, 4, 3), 1, 101), Error);
    EXPECT_THROW(encode_jpeg(ramp(4, 4, 3), 0), Error);
}

TEST_F(ImageFile, refusals_name_the_file_and_the_reason) {
    const fs::path path = directory_ / "a.png";
    EXPECT_NE(refusal(path).find("no such file"), std::string::npos);
    EXPECT_NE(refusal(path).find("a.png"), std::string::npos);
    EXPECT_NE(refusal(directory_).find("not a plain file"), std::string::npos);
    save(path, {});
    EXPECT_NE(refusal(path), "");
    save(path, {'h', 'e', 'l', 'l', 'o'});
    EXPECT_NE(refusal(path), "");
    write_image(path, ramp(40, 30, 3));
    EXPECT_EQ(refusal(path, 1200), "");
    EXPECT_NE(refusal(path, 1199).find("40x30"), std::string::npos);
    EXPECT_THROW(decode_image({}, "nothing"), Error);
    const unsigned char letters[] = {'h', 'e', 'l', 'l', 'o'};
    EXPECT_THROW(decode_image(letters, "letters"), Error);
}

TEST_F(ImageFile, a_header_that_claims_too_much_is_refused_before_memory_is_taken) {
    // A complete PNG whose header says 16384 x 16384 pixels: 800 MB of samples in 100 bytes.
    std::vector<unsigned char> png = encode_png(Image(1, 1, 3));
    const auto patch = [&](std::size_t offset, std::uint32_t value) {
        for (int i = 0; i < 4; ++i)
            png[offset + static_cast<std::size_t>(i)] = static_cast<unsigned char>(value >> (24 - 8 * i));
    };
    patch(16, 16384);
    patch(20, 16384);
    std::uint32_t crc = ~0u;  // CRC of type and data of the IHDR chunk, ISO 3309
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= png[i];
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0);
    }
    patch(29, ~crc);
    save(directory_ / "a.png", png);
    EXPECT_NE(refusal(directory_ / "a.png", std::size_t{1} << 28).find("too few"), std::string::npos);
}

TEST_F(ImageFile, truncated_and_damaged_pictures_never_crash) {
    for (const std::string& name : names()) {
        write_image(directory_ / name, ramp(20, 10, 3), 1, {{"hogel_command", "x"}});
        const std::vector<unsigned char> whole = bytes_of(directory_ / name);
        for (std::size_t length = 0; length < whole.size(); length += 7) {
            try {
                decode_image({whole.data(), length}, name, 1 << 20);
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::bad_input);
            }
        }
        for (std::size_t offset = 0; offset < std::min<std::size_t>(whole.size(), 300); ++offset)
            for (const unsigned char value : {0x00, 0x7f, 0xff}) {
                std::vector<unsigned char> damaged = whole;
                damaged[offset] = value;
                try {
                    decode_image(damaged, name, 1 << 20);
                } catch (const Error& error) {
                    EXPECT_EQ(error.code(), ErrorCode::bad_input);
                    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
                }
            }
    }
}

TEST_F(ImageFile, a_failed_write_says_why_and_leaves_no_file) {
    const auto code = [&](const fs::path& path, const Image& image, double exposure) -> int {
        try {
            write_image(path, image, exposure);
        } catch (const Error& error) {
            return static_cast<int>(error.code());
        }
        return 0;
    };
    const Image image = ramp(4, 4, 3);
    EXPECT_EQ(code(directory_ / "a.jpg", image, 1), 2);
    const bool tiff = format_by_extension("a.tif")->built_in;
    EXPECT_EQ(code(directory_ / "none" / "a.tif", image, 1), tiff ? 4 : 5);
    EXPECT_EQ(code(directory_ / "a", image, 1), 2);
    EXPECT_EQ(code(directory_ / "a.png", image, 0), 2);
    EXPECT_EQ(code(directory_ / "a.png", image, nan), 2);
    EXPECT_EQ(code(directory_ / "none" / "a.png", image, 1), 4);
    EXPECT_EQ(code(directory_ / "a.png", Image(), 1), 4);
    EXPECT_EQ(code(directory_ / "a.png", Image(2, 2, 2), 1), 4);
    EXPECT_TRUE(fs::is_empty(directory_));
    EXPECT_EQ(code(directory_ / "A.PNG", image, 1), 0);
}

TEST(AutomaticExposure, brings_the_brightest_half_percent_to_white) {
    Image image(100, 10, 3);
    for (std::size_t i = 0; i < 1000; ++i) image.pixels(i / 100, i % 100, i % 3) = static_cast<float>(i + 1);
    EXPECT_NEAR(automatic_exposure(image), 1 / 995.0, 1e-6);
    image.pixels(0, 0, 0) = nan;
    image.pixels(0, 1, 0) = infinite;
    EXPECT_NEAR(automatic_exposure(image), 1 / 995.0, 1e-6);
    EXPECT_EQ(automatic_exposure(Image(10, 10, 3)), 1);
    EXPECT_EQ(automatic_exposure(Image()), 1);
    Image star(100, 100, 1);
    star.pixels(50, 50, 0) = 4;
    EXPECT_EQ(automatic_exposure(star), 0.25);
}

TEST(AutomaticExposure, leaves_a_white_body_on_black_its_shades) {
    // A body on a third of the picture; most of it is nearly as bright as its maximum.
    Image image(100, 90, 3);
    for (std::size_t i = 0; i < 3000; ++i)
        for (std::size_t c = 0; c < 3; ++c) image.pixels(i / 100, i % 100, c) = i < 300 ? 0.3f : i < 2900 ? 1.8f : 2.0f;
    EXPECT_NEAR(automatic_exposure(image), 0.55 / 1.8, 1e-6);
    // The highlight of a dark body is white.
    for (std::size_t i = 300; i < 2900; ++i)
        for (std::size_t c = 0; c < 3; ++c) image.pixels(i / 100, i % 100, c) = 0.5f;
    EXPECT_NEAR(automatic_exposure(image), 0.5, 1e-6);
}

TEST(AutomaticExposure, passes_a_background_over) {
    // A body on a third of the picture, in front of black, brighter and darker backgrounds.
    const auto picture = [](Rgb background, bool says_so) {
        Image image(100, 90, 3);
        for (std::size_t i = 0; i < 9000; ++i) {
            const float body = i < 300 ? 0.05f : i < 2900 ? 0.2f : 0.3f;
            const Rgb color = i < 3000 ? Rgb{body, body, body} : background;
            image.pixels(i / 100, i % 100, 0) = color.r;
            image.pixels(i / 100, i % 100, 1) = color.g;
            image.pixels(i / 100, i % 100, 2) = color.b;
        }
        if (says_so) image.provenance.entries.push_back(background_entry(background));
        return image;
    };
    const double on_black = automatic_exposure(picture({0, 0, 0}, false));
    EXPECT_GT(on_black, 2);
    for (const Rgb background : {Rgb{1, 1, 1}, Rgb{0.02f, 0.02f, 0.03f}, Rgb{0, 0, 7}}) {
        EXPECT_EQ(automatic_exposure(picture(background, true)), on_black);
        EXPECT_NE(automatic_exposure(picture(background, false)), on_black);
    }
    EXPECT_EQ(background_of({{{"background", "0.5 0.25 1"}}, {}}), (Rgb{0.5f, 0.25f, 1}));
    for (const char* other : {"", "white", "1 1", "1 1 1 1", "nan 0 0"})
        EXPECT_EQ(background_of({{{"background", other}}, {}}), (Rgb{0, 0, 0})) << other;
}

}  // namespace
}  // namespace hogel::image
