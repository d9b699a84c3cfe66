// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "hogel/error.h"
#include "hogel/image.h"

namespace hogel::image {
namespace {

namespace fs = std::filesystem;

class WithoutPictures : public testing::Test {
  protected:
    WithoutPictures() { fs::create_directories(directory_); }
    ~WithoutPictures() override { fs::remove_all(directory_); }

    /// Returns the message of a call that must throw not_built_in.
    static std::string refusal(const std::function<void()>& work) {
        try {
            work();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::not_built_in) << error.what();
            return error.what();
        }
        ADD_FAILURE() << "was accepted";
        return {};
    }

    fs::path directory_ = fs::path(testing::TempDir()) / ("hogel_no_pictures_" + std::to_string(::getpid()));
};

TEST_F(WithoutPictures, every_format_is_refused_by_name_before_a_file_is_made) {
    for (const auto& [name, title] : {std::pair{"a.png", "PNG"}, {"a.exr", "OpenEXR"}, {"a.JPG", "JPEG"}}) {
        const fs::path path = directory_ / name;
        for (const std::string& message :
             {refusal([&] { write_image(path, Image(2, 2, 3)); }), refusal([&] { require_picture_name(path); })})
            EXPECT_EQ(message, "'" + path.string() + "': this build of hogel neither reads nor writes " + title +
                                   "; the build option HOGEL_PICTURES=ON brings it");
        EXPECT_FALSE(fs::exists(path));
    }
    EXPECT_NE(refusal([] { encode_png(Image(2, 2, 3)); }).find("HOGEL_PICTURES"), std::string::npos);
    EXPECT_NE(refusal([] { encode_jpeg(Image(2, 2, 3)); }).find("HOGEL_PICTURES"), std::string::npos);
}

TEST_F(WithoutPictures, files_are_refused_by_their_first_bytes) {
    const std::string rest(64, '\0');
    for (const auto& [start, title] : {std::pair{std::string("\x89PNG\r\n\x1a\n"), "PNG"},
                                       {"\xff\xd8\xff", "JPEG"},
                                       {"\x76\x2f\x31\x01", "OpenEXR"},
                                       {"GIF89a", "GIF"},
                                       {"BM", "BMP"},
                                       {"#?RADIANCE", "HDR"},
                                       {std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0", 18), "TGA"}}) {
        std::ofstream(directory_ / "a", std::ios::binary) << start << rest;
        const std::string message = refusal([&] { read_image(directory_ / "a"); });
        EXPECT_NE(message.find(std::string("neither reads nor writes ") + title + ";"), std::string::npos) << message;
    }
}

TEST_F(WithoutPictures, bitmaps_of_levels_are_still_written) {
    Array<std::uint8_t, 3> levels({2, 3, 1});
    write_raw_pixels(directory_ / "a.bmp", levels);
    EXPECT_EQ(fs::file_size(directory_ / "a.bmp"), 54 + 1024 + 2 * 4u);
    const std::string message = refusal([&] { write_raw_pixels(directory_ / "a.png", levels); });
    EXPECT_NE(message.find("brings it, and BMP would do"), std::string::npos) << message;
}

}  // namespace
}  // namespace hogel::image
