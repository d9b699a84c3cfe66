// SPDX-License-Identifier: Apache-2.0
// Rotated cameras are detected from their pictures, and shifted ones are not.
#include "hogel/exchange/rectified.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hogel/error.h"
#include "hogel/exchange/test_views.h"

namespace hogel::exchange {
namespace {

const TestScene scene{.columns = 5, .rows = 3, .width = 224, .height = 192, .spacing = 0.015, .far = 0.012};

// Rotation of the cameras towards the middle of the hologram, about the named axes.
struct Turned {
    bool about_y = false, about_x = false;
};

// Returns the view of the camera in row r and column c: rotated towards the middle, with the centre in the middle of
// the picture, or, without rotation, shifted such that the pictures agree on the hologram.
Array<std::uint8_t, 3> view_of(std::size_t r, std::size_t c, const Turned& turned, double lower = 0) {
    const double cx = scene.camera_x(c), cy = scene.camera_y(r), focal = scene.distance;
    const double yaw = turned.about_y ? std::atan(-cx / focal) : 0, pitch = turned.about_x ? std::atan(-cy / focal) : 0;
    Array<std::uint8_t, 3> view({scene.height, scene.width, 1});
    for (std::size_t j = 0; j < scene.height; ++j)
        for (std::size_t i = 0; i < scene.width; ++i) {
            double x = scene.pixel_x(i) - (turned.about_y ? 0 : cx);
            double y = scene.pixel_y(j) + lower * scene.pixel - (turned.about_x ? 0 : cy), z = focal;
            const double x1 = x * std::cos(yaw) + z * std::sin(yaw), z1 = z * std::cos(yaw) - x * std::sin(yaw);
            const double y1 = y * std::cos(pitch) + z1 * std::sin(pitch),
                         z2 = z1 * std::cos(pitch) - y * std::sin(pitch);
            const double s = cx + x1 / z2 * focal, t = cy + y1 / z2 * focal;
            view(j, i, 0) = static_cast<std::uint8_t>(std::lround(240 * scene.radiance(cx, cy, s, t)));
        }
    return view;
}

void write_set(const TestFolder& folder, const Turned& turned, double lower_a_column = 0) {
    for (std::size_t r = 0; r < scene.rows; ++r)
        for (std::size_t c = 0; c < scene.columns; ++c)
            folder.write(fmt::format("input_Cam{:03}.png", r * scene.columns + c),
                         image::png_file(view_of(r, c, turned, lower_a_column * static_cast<double>(c)).view(), {},
                                         image::Curve::srgb));
}

ViewImportOptions options_of() {
    ViewImportOptions options;
    options.columns = scene.columns;
    options.rows = scene.rows;
    return options;
}

std::string error_of(const TestFolder& folder) {
    try {
        import_views(folder.path(), options_of());
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        return error.what();
    }
    return "nothing";
}

Array<float, 2> grey(const Array<std::uint8_t, 3>& view) {
    Array<float, 2> out({view.extent(0), view.extent(1)});
    std::ranges::transform(view.elements(), out.data(),
                           [](std::uint8_t code) { return static_cast<float>(code) / 255; });
    return out;
}

TEST(Rectified, KeystoneIsThatOfTheAngle) {
    // Two columns on, the cameras are turned by θ: at a corner x y θ/f.
    const double angle = std::atan(2 * scene.spacing / scene.distance);
    const double expected =
        0.25 * static_cast<double>(scene.width * scene.height) * angle * scene.pixel / scene.distance;
    const CrossParallax across =
        cross_parallax(grey(view_of(1, 2, {true, false})), grey(view_of(1, 4, {true, false})), false, 20);
    ASSERT_GT(across.blocks, 50u);
    EXPECT_NEAR(std::abs(across.keystone), expected, 0.2 * expected);
    EXPECT_LT(std::abs(across.shift), 0.15);
    const double angle_down = std::atan(scene.spacing / scene.distance);
    const CrossParallax down =
        cross_parallax(grey(view_of(1, 2, {false, true})), grey(view_of(2, 2, {false, true})), true, 20);
    EXPECT_NEAR(std::abs(down.keystone), expected * angle_down / angle, 0.2 * expected);
    // The other way round it has the other sign.
    const CrossParallax back =
        cross_parallax(grey(view_of(1, 4, {true, false})), grey(view_of(1, 2, {true, false})), false, 20);
    EXPECT_LT(across.keystone * back.keystone, 0);
}

TEST(Rectified, TurnedCamerasAreRefusedByTheirPictures) {
    const TestFolder folder;
    write_set(folder, {true, false});
    EXPECT_NE(error_of(folder).find("input_Cam009.png: the cameras are turned against each other (toe-in): against "
                                    "input_Cam007.png it is keystoned up and down by"),
              std::string::npos)
        << error_of(folder);
    write_set(folder, {true, true});
    EXPECT_NE(error_of(folder).find("toe-in"), std::string::npos) << error_of(folder);
}

TEST(Rectified, ShiftedCamerasAreNot) {
    const TestFolder folder;
    write_set(folder, {});
    const ImportedViews views = import_views(folder.path(), options_of());
    for (const std::string& note : views.notes) EXPECT_EQ(note.find("rectified"), std::string::npos) << note;
    const CrossParallax found = cross_parallax(grey(view_of(1, 1, {})), grey(view_of(1, 3, {})), false, 20);
    ASSERT_GT(found.blocks, 50u);
    EXPECT_LT(std::abs(found.keystone), 0.1);
    EXPECT_LT(std::abs(found.shift) + std::abs(found.roll) + std::abs(found.zoom), 0.2);
}

TEST(Rectified, OtherDisagreementIsNoted) {
    const TestFolder folder;
    write_set(folder, {}, 0.6);
    const ImportedViews views = import_views(folder.path(), options_of());
    EXPECT_TRUE(std::ranges::any_of(views.notes, [](const std::string& note) {
        return note.starts_with("the views are not rectified: points move up or down by up to 1.") &&
               note.find(" from input_Cam0") != std::string::npos;
    })) << fmt::format("{}", views.notes.empty() ? "no notes" : views.notes.front());
}

TEST(Rectified, ASmallThingInTheMiddleSaysLittleOfCorners) {
    // Texture in the middle alone, turned a little.
    Array<float, 2> a = grey(view_of(1, 1, {true, false})), b = grey(view_of(1, 3, {true, false}));
    for (Array<float, 2>* view : {&a, &b})
        for (std::size_t y = 0; y < scene.height; ++y)
            for (std::size_t x = 0; x < scene.width; ++x)
                if (y < 56 || y > 136 || x < 64 || x > 160) (*view)(y, x) = 0.5f;
    const CrossParallax found = cross_parallax(a, b, false, 12);
    EXPECT_GE(found.blocks, 24u);
    EXPECT_LT(found.corner, 0.25);
    EXPECT_LT(std::abs(found.keystone) * found.corner, 0.5);
}

TEST(Rectified, PicturesWithoutTextureSayNothing) {
    const Array<float, 2> flat({192, 224}, 0.5f);
    EXPECT_EQ(cross_parallax(flat, flat, false, 20).blocks, 0u);
    const Array<float, 2> small({12, 12}, 0.5f);
    EXPECT_EQ(cross_parallax(small, small, true, 20).blocks, 0u);
}

}  // namespace
}  // namespace hogel::exchange
