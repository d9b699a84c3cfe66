// SPDX-License-Identifier: Apache-2.0
// Exchanges files with OpenImageIO's oiiotool in both directions; skipped if it is not installed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "hogel/error.h"
#include "hogel/image.h"
#include "hogel/image/picture_formats.h"

namespace hogel::image {
namespace {

namespace fs = std::filesystem;

class OiioTool : public testing::Test {
  protected:
    void SetUp() override {
        if (std::system("oiiotool --help >/dev/null 2>&1") != 0) GTEST_SKIP() << "oiiotool is not installed";
        fs::create_directories(folder_);
    }
    ~OiioTool() override { fs::remove_all(folder_); }

    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    static void run(const std::string& words) {
        ASSERT_EQ(std::system(("oiiotool " + words + " >/dev/null 2>&1").c_str()), 0) << words;
    }
    static std::string output(const std::string& words) {
        std::string text;
        FILE* pipe = ::popen(("oiiotool " + words).c_str(), "r");
        for (int letter = 0; pipe != nullptr && (letter = std::fgetc(pipe)) != EOF;) text += static_cast<char>(letter);
        if (pipe != nullptr) ::pclose(pipe);
        return text;
    }
    // The numbers of each pixel, row by row, as oiiotool prints them.
    static std::vector<double> pixels(const std::string& path) {
        std::istringstream lines(output("--info -v --dumpdata " + path));
        std::vector<double> values;
        for (std::string line; std::getline(lines, line);) {
            const std::size_t colon = line.find("): ");
            if (line.find("Pixel (") == std::string::npos || colon == std::string::npos) continue;
            std::istringstream numbers(line.substr(colon + 3));
            for (std::string number; numbers >> number && number.find('(') == std::string::npos;)
                values.push_back(std::stod(number));
        }
        return values;
    }

    fs::path folder_ = fs::path(testing::TempDir()) / ("hogel_oiiotool_" + std::to_string(::getpid()));
};

// Display values 0 to 255 in the first channel, others shifted.
Image display_ramp(std::size_t channels) {
    Image image(16, 16, channels);
    for (std::size_t i = 0; i < 256; ++i)
        for (std::size_t c = 0; c < channels; ++c)
            image.pixels(i / 16, i % 16, c) = srgb_decode(static_cast<float>((i + 50 * c) % 256) / 255);
    return image;
}

TEST_F(OiioTool, reads_the_pixels_and_texts_that_hogel_writes) {
    const Metadata texts{{"software", "hogel 1"}, {"option pitch", "1.5um"}};
    for (const std::size_t channels : {1, 3}) {
        const Image image = display_ramp(channels);
        write_image(file("a.png"), image, 1, texts);
        write_image(file("a.exr"), image, 1, texts);
        const std::vector<double> png = pixels(file("a.png")), exr = pixels(file("a.exr"));
        ASSERT_EQ(png.size(), image.pixels.size());
        ASSERT_EQ(exr.size(), image.pixels.size());
        for (std::size_t i = 0; i < png.size(); ++i) {
            const float linear = image.pixels.data()[i];
            EXPECT_NEAR(png[i], std::lround(255 * srgb_encode(linear)), 0.01) << i;
            EXPECT_NEAR(exr[i], linear, linear / 1024 + 1e-7) << i;
        }
        for (const char* name : {"a.png", "a.exr"}) {
            const std::string facts = output("--info -v " + file(name));
            EXPECT_NE(facts.find("software: \"hogel 1\""), std::string::npos) << facts;
            EXPECT_NE(facts.find("option pitch: \"1.5um\""), std::string::npos) << facts;
            EXPECT_NE(facts.find(channels == 1 ? "channel list: Y" : "channel list: R, G, B"), std::string::npos)
                << facts;
        }
    }
}

TEST_F(OiioTool, writes_exr_files_that_are_read_exactly) {
    // Floats that are no half floats, in scanlines and tiles, with every lossless compression and a data window that
    // does not begin at 0.
    write_image(file("a.exr"), display_ramp(3));
    run(file("a.exr") + " --mulc 0.3333333 -d float -o " + file("b.exr"));
    const Image expected = read_image(file("b.exr"));
    ASSERT_EQ(expected.channels(), 3u);
    const std::vector<double> printed = pixels(file("b.exr"));
    for (std::size_t i = 0; i < printed.size(); ++i) ASSERT_NEAR(expected.pixels.data()[i], printed[i], 1e-9) << i;
    for (const std::string words :
         {"--compression none", "--compression rle", "--compression zips", "--compression zip", "--compression piz",
          "--tile 8 8", "--tile 7 5 --compression piz", "--origin +100-7", "--ch R,G,B,A=0.5", "--ch B,G,R,Z=7",
          "--chnames left.R,left.G,left.B"}) {
        run(file("b.exr") + " " + words + " -d float -o " + file("c.exr"));
        const Image image = read_image(file("c.exr"));
        ASSERT_EQ(image.pixels.shape(), expected.pixels.shape()) << words;
        EXPECT_TRUE(std::ranges::equal(image.pixels.elements(), expected.pixels.elements())) << words;
    }
    run(file("b.exr") + " --ch G --chnames Y -d half -o " + file("y.exr"));
    const Image grey = read_image(file("y.exr"));
    ASSERT_EQ(grey.channels(), 1u);
    for (std::size_t i = 0; i < 256; ++i) {
        const float green = expected.pixels(i / 16, i % 16, 1u);
        EXPECT_NEAR(grey.pixels(i / 16, i % 16, 0u), green, green / 2048 + 1e-7);
    }
    run(file("b.exr") + " -d uint32 -o " + file("u.exr"));
    const Image whole = read_image(file("u.exr"));
    for (std::size_t i = 0; i < whole.pixels.size(); ++i)
        ASSERT_NEAR(whole.pixels.data()[i], expected.pixels.data()[i], 1e-6) << i;
}

TEST_F(OiioTool, writes_integers_that_are_read_exactly) {
    const Image image = display_ramp(3);
    write_image(file("a.png"), image);
    std::vector<std::string> names{"b.bmp", "b.tga", "b.png"};
    if (format_by_extension("b.tif")->built_in) names.push_back("b.tif");
    for (const std::string& name : names) {
        run(file("a.png") + " -o " + file(name));
        const Image read = read_image(file(name));
        ASSERT_EQ(read.pixels.shape(), image.pixels.shape()) << name;
        for (std::size_t i = 0; i < read.pixels.size(); ++i)
            ASSERT_NEAR(read.pixels.data()[i], image.pixels.data()[i], 1e-6) << name << ' ' << i;
    }
    // All levels of 16 bits.
    run("--pattern fill:topleft=0:topright=0.2:bottomleft=0.8:bottomright=1 32x32 1 -d uint16 -o " + file("deep.png"));
    const RawPixels deep = read_raw_pixels(file("deep.png"));
    EXPECT_EQ(deep.levels, 65536u);
    const std::vector<double> expected = pixels(file("deep.png"));
    ASSERT_EQ(expected.size(), deep.values.size());
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(deep.values.data()[i], expected[i]) << i;
}

TEST_F(OiioTool, writes_webp_files_that_are_read_or_refused_by_name) {
    Image image(32, 32, 3);
    std::ranges::fill(image.pixels.elements(), 0.25f);
    write_image(file("a.png"), image);
    run(file("a.png") + " -o " + file("b.webp"));
    if (format_by_extension("b.webp")->built_in) {
        const Image read = read_image(file("b.webp"));
        ASSERT_EQ(read.pixels.shape(), image.pixels.shape());
        for (const float value : read.pixels.elements()) EXPECT_NEAR(value, 0.25f, 0.02f);
        return;
    }
    try {
        read_image(file("b.webp"));
        FAIL() << "was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::not_built_in);
        EXPECT_NE(std::string(error.what()).find("WebP"), std::string::npos);
    }
}

TEST_F(OiioTool, writes_jpeg_and_hdr_files_that_are_read) {
    Image smooth(32, 32, 3);
    for (std::size_t i = 0; i < smooth.pixels.size(); ++i) {
        const std::size_t level = 60 + i / 24;
        smooth.pixels.data()[i] = srgb_decode(static_cast<float>(level) / 255);
    }
    write_image(file("a.png"), smooth);
    run(file("a.png") + " --quality 100 -o " + file("b.jpg"));
    write_image(file("a.exr"), smooth);
    run(file("a.exr") + " -o " + file("b.hdr"));
    const Image jpeg = read_image(file("b.jpg")), hdr = read_image(file("b.hdr"));
    ASSERT_EQ(jpeg.pixels.shape(), smooth.pixels.shape());
    ASSERT_EQ(hdr.pixels.shape(), smooth.pixels.shape());
    for (std::size_t i = 0; i < smooth.pixels.size(); ++i) {
        const float value = smooth.pixels.data()[i];
        ASSERT_NEAR(srgb_encode(jpeg.pixels.data()[i]), srgb_encode(value), 0.015) << i;
        ASSERT_NEAR(hdr.pixels.data()[i], value, value / 100) << i;
    }
}

}  // namespace
}  // namespace hogel::image
