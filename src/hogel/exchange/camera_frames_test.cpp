// SPDX-License-Identifier: Apache-2.0
// transforms.json: cameras as defined by the documentation of nerfstudio and instant-ngp, and rejected files.
#include "hogel/exchange/camera_frames.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "hogel/error.h"
#include "hogel/exchange/test_views.h"
#include "hogel/image.h"

namespace hogel::exchange {
namespace {

const TestScene scene{.columns = 4, .rows = 3};

struct Frame {
    std::string name;
    double x, y, z;         // in the frame of the cameras: right, up, back
    double cx, cy, fl = 0;  // fl 0: the common one
    double turn = 0;        // about y, radians
    std::string more;
};

// Modification of the frames by a test before they are written.
using Change = std::function<void(std::vector<Frame>&)>;

// The cameras of the scene, with a common rotation, in a world of ten times the size.
void write_set(const TestFolder& folder, const Change& change = {}, const std::string& common = "") {
    const double focal = scene.distance / scene.pixel;
    std::vector<Frame> frames;
    for (std::size_t r = 0; r < scene.rows; ++r)
        for (std::size_t c = 0; c < scene.columns; ++c) {
            const double x = scene.camera_x(c), y = scene.camera_y(r);
            frames.push_back({fmt::format("shot{}.png", (r * 7 + c * 5) % 23), 10 * x, 10 * y, 10 * scene.distance,
                              0.5 * static_cast<double>(scene.width) + x / scene.pixel,
                              0.5 * static_cast<double>(scene.height) - y / scene.pixel, 0, 0, ""});
            folder.write(frames.back().name, scene.png(r, c));
        }
    std::swap(frames[1], frames[9]);  // in no order
    if (change) change(frames);
    // A rotation about (1, 1, 1) by 120 degrees takes x to y, y to z, and z to x.
    std::string text = fmt::format("{{\"w\": {}, \"h\": {}, {} \"fl_x\": {}, \"fl_y\": {}, \"frames\": [", scene.width,
                                   scene.height, common, focal, focal);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Frame& f = frames[i];
        const double c = std::cos(f.turn), s = std::sin(f.turn);
        text += fmt::format(
            "{}{{\"file_path\": \"./{}\", \"cx\": {}, \"cy\": {}, {} {} \"transform_matrix\": [[{}, 0, {}, {}], "
            "[{}, 0, {}, {}], [0, 1, 0, {}], [0, 0, 0, 1]]}}",
            i > 0 ? ", " : "", f.name, f.cx, f.cy, f.fl > 0 ? fmt::format("\"fl_x\": {},", f.fl) : "", f.more, -s, c,
            f.z + 3, c, s, f.x - 5, f.y + 7);
    }
    folder.write("transforms.json", text + "]}");
}

std::string error_of(const std::filesystem::path& source) {
    try {
        import_views(source, {});
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input) << error.what();
        return error.what();
    }
    return "nothing";
}

void expect_error(const Change& change, const std::string& expected, const std::string& common = "") {
    const TestFolder folder;
    write_set(folder, change, common);
    const std::string error = error_of(folder.path());
    EXPECT_NE(error.find(expected), std::string::npos) << error;
}

TEST(CameraFrames, BecomeTheRaysOfTheScene) {
    const TestFolder folder;
    write_set(folder);
    ViewImportOptions options;
    options.size = static_cast<double>(scene.width) * scene.pixel;
    const ImportedViews views = import_views(folder.path(), options);
    EXPECT_EQ(views.layout, "transforms");
    EXPECT_TRUE(views.assumed.empty());
    EXPECT_NEAR(views.scale, 0.1, 1e-9);
    EXPECT_NEAR(views.spacing, scene.spacing, 1e-9);
    EXPECT_NEAR(views.distance, scene.distance, 1e-9);
    const LightFieldGrid& grid = views.light_field.grid();
    ASSERT_EQ(grid.directions_u, scene.columns);
    ASSERT_EQ(grid.directions_v, scene.rows);
    LightFieldTile tile(grid, {0, 0, scene.width, scene.height}, false);
    views.light_field.front().read(tile);
    std::size_t wrong = 0;
    for (std::size_t l = 0; l < scene.rows; ++l)
        for (std::size_t k = 0; k < scene.columns; ++k) {
            const LightFieldGrid hogel = grid.of_hogel(20, 30);
            const double s = grid.s(20), t = grid.t(30);
            const double x = s - hogel.u(static_cast<double>(k)) * scene.distance,
                         y = t - hogel.v(static_cast<double>(l)) * scene.distance;
            wrong += std::abs(255 * srgb_encode(tile.radiance(0, 30, 20, l, k)) -
                              std::round(200 * scene.radiance(x, y, s, t))) > 1.5;
        }
    EXPECT_EQ(wrong, 0u);
    // The file itself is the set as well.
    EXPECT_EQ(import_views(folder.path() / "transforms.json", options).columns, scene.columns);
}

TEST(CameraFrames, PicturesThatAreNotShiftedAgreeAtInfinity) {
    const TestFolder folder;
    write_set(folder, [](std::vector<Frame>& frames) {
        for (Frame& frame : frames) frame.cx = 32, frame.cy = 24;
    });
    ViewImportOptions options;
    options.disparity = 2;
    const ImportedViews views = import_views(folder.path(), options);
    // Two pixels from a camera to the next, 0.1 apart: f b / 2.
    EXPECT_NEAR(views.distance / views.scale, 0.1 * 600 / 2, 1e-6);
    try {
        import_views(folder.path(), {});
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("they agree at infinity"), std::string::npos) << error.what();
    }
}

TEST(CameraFrames, TurnedCamerasAreRefusedWithTheAngle) {
    expect_error([](auto& frames) { frames[5].turn = 0.05; }, "shot12.png: its camera is turned by 2.86 degrees");
    // A turn that moves the picture by less than half a pixel is rounding.
    const TestFolder folder;
    write_set(folder, [](auto& frames) { frames[5].turn = 0.4 / 600; });
    EXPECT_EQ(error_of(folder.path()), "nothing");
}

TEST(CameraFrames, WhatIsNoGridIsRefused) {
    expect_error([](auto& frames) { frames[5].z += 0.03; }, "shot12.png: its camera stands 0.0");
    expect_error([](auto& frames) { frames[5].x += 0.035; }, "spacings away from its grid position");
    expect_error([](auto& frames) { frames[5] = frames[2]; }, "stands where that of");
    expect_error([](auto& frames) { frames.erase(frames.begin() + 5); },
                 "no camera stands in row 1 from the top and column 1 from the left; there are 11 of 4x3");
    expect_error([](auto& frames) { frames[5].fl = 500; }, "shot12.png: its focal length is 500 pixels");
    expect_error([](auto& frames) { frames[5].cx += 8; }, "shot12.png: its centre (cx, cy) is");
    expect_error(
        [](auto& frames) {
            for (Frame& frame : frames) frame.cx = 64 - frame.cx, frame.cy = 48 - frame.cy;
        },
        "agree behind the cameras");
}

TEST(CameraFrames, WhatIsNoPinholeIsRefused) {
    expect_error({}, "frames[0]: k1 is 0.1: its picture is distorted", "\"k1\": 0.1,");
    expect_error([](auto& frames) { frames[3].more = "\"p2\": 0.1,"; }, "frames[3]: p2 is 0.1");
    expect_error({}, "the camera model OPENCV_FISHEYE is no pinhole", "\"camera_model\": \"OPENCV_FISHEYE\",");
    expect_error([](auto& frames) { frames[3].name = "gone"; }, "gone: is not there, though transforms.json has");
}

TEST(CameraFrames, PicturesElsewhereAreNotRead) {
    const TestFolder folder;
    std::filesystem::create_directory(folder.path() / "set");
    folder.write("other.png", scene.png(0, 0));
    std::filesystem::create_symlink(folder.path() / "other.png", folder.path() / "set" / "link.png");
    for (const std::string& name : {std::string("../other.png"), (folder.path() / "other").string(),
                                    std::string("a/../../other.png"), std::string("link.png")}) {
        folder.write("set/transforms.json",
                     fmt::format("{{\"fl_x\": 9, \"frames\": [{{\"file_path\": \"{}\"}}, {{}}]}}", name));
        const std::string error = error_of(folder.path() / "set");
        EXPECT_NE(error.find("is not in this file's folder or below"), std::string::npos) << error;
    }
}

TEST(CameraFrames, DamagedFilesAreRefusedAtEveryLength) {
    const TestFolder folder;
    write_set(folder);
    std::ifstream stream(folder.path() / "transforms.json");
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    for (std::size_t length = 0; length < text.size(); length += length < 300 ? 1 : 37) {
        folder.write("transforms.json", text.substr(0, length));
        EXPECT_NE(error_of(folder.path()), "nothing") << length;
    }
    for (const char* wrong : {"[]", "{}", "{\"frames\": 3}", "{\"frames\": [1, 2]}", "{\"frames\": [{}, {}]}",
                              "{\"frames\": [{\"file_path\": \"shot0.png\", \"w\": 1e999}, {}]}",
                              "{\"frames\": [{\"file_path\": \"shot0.png\", \"transform_matrix\": "
                              "[[1,0,0,0],[0,1,0,0],[0,0,-1,0]]}, {}]}"}) {
        folder.write("transforms.json", std::string(wrong));
        EXPECT_NE(error_of(folder.path()).find("transforms.json"), std::string::npos) << wrong;
    }
    std::string scaled = text;
    scaled.replace(scaled.find("\"w\": "), 5, "\"w\": 1");
    folder.write("transforms.json", scaled);
    EXPECT_NE(error_of(folder.path()).find("transforms.json: says that"), std::string::npos) << error_of(folder.path());
    folder.write("transforms.json", "{\"frames\": " + std::string(100000, '['));
    EXPECT_NE(error_of(folder.path()).find("nests deeper"), std::string::npos);
}

}  // namespace
}  // namespace hogel::exchange
