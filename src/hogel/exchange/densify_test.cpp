// SPDX-License-Identifier: Apache-2.0
// Interpolated views and the depth of rays, compared with a scene of known views and depth.
#include "hogel/exchange/densify.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "hogel/error.h"
#include "hogel/exchange/test_views.h"
#include "hogel/image.h"

namespace hogel::exchange {
namespace {

// Every second view of this scene forms the set, so that ground truth exists for the others.
const TestScene scene{.columns = 5, .rows = 5, .width = 96, .height = 80, .near = -0.04, .far = 0.04};

// Disparity of a pixel in pixels, from a view of the set to the next, two cameras to the right.
float disparity_at(std::size_t row, std::size_t column, std::size_t y, std::size_t x) {
    const double depth = scene.depth(scene.camera_x(column), scene.camera_y(row), scene.pixel_x(x), scene.pixel_y(y));
    return static_cast<float>(-2 * scene.spacing * depth / (scene.distance + depth) / scene.pixel);
}

Array<float, 3> map_of(std::size_t row, std::size_t column) {
    Array<float, 3> map({scene.height, scene.width, 1});
    for (std::size_t y = 0; y < scene.height; ++y)
        for (std::size_t x = 0; x < scene.width; ++x) map(y, x, 0) = disparity_at(row, column, y, x);
    return map;
}

void write_views(const TestFolder& folder) {
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            folder.write(fmt::format("input_Cam{:03}.png", 3 * r + c), scene.png(2 * r, 2 * c));
}

ViewImportOptions options_of() {
    ViewImportOptions options;
    options.size = static_cast<double>(scene.width) * scene.pixel;
    options.distance = scene.distance;
    options.spacing = 2 * scene.spacing;
    return options;
}

// Mean squared error of the views that were held out, in codes of 0 to 1.
double error_of(const LightField& light_field) {
    const LightFieldGrid& grid = light_field.grid();
    EXPECT_EQ(grid.directions_u, scene.columns);
    EXPECT_EQ(grid.directions_v, scene.rows);
    LightFieldTile tile(grid, {0, 0, grid.hogels_s, grid.hogels_t}, false);
    light_field.front().read(tile);
    double sum = 0, count = 0;
    for (std::size_t r = 0; r < scene.rows; ++r)
        for (std::size_t c = 0; c < scene.columns; ++c) {
            const Array<std::uint8_t, 3> view = scene.view(r, c);
            double worst = 0;
            for (std::size_t y = 0; y < scene.height; ++y)
                for (std::size_t x = 0; x < scene.width; ++x) {
                    const double off = srgb_encode(tile.radiance(0, y, x, 4 - r, 4 - c)) - view(y, x, 0) / 255.0;
                    worst = std::max(worst, std::abs(off));
                    if (r % 2 + c % 2 > 0) sum += off * off, count += 1;
                }
            const bool own = r % 2 + c % 2 == 0;
            EXPECT_LT(own ? worst : 0, 1e-3) << "a view of the set itself is changed";
        }
    return sum / count;
}

TEST(Densify, ViewsBetweenAreThoseOfTheCamerasThere) {
    for (const bool all_maps : {false, true}) {
        const TestFolder folder;
        write_views(folder);
        if (all_maps)
            for (std::size_t i = 0; i < 9; ++i)
                folder.write(fmt::format("gt_disp_Cam{:03}.pfm", i), image::pfm_file(map_of(i / 3 * 2, i % 3 * 2)));
        else
            folder.write("gt_disp_lowres.pfm", image::pfm_file(map_of(2, 2)));
        folder.write("gt_disp_highres.pfm", image::pfm_file(Array<float, 3>({160, 192, 1})));
        ViewImportOptions options = options_of();
        options.densify = 2;
        const ImportedViews views = import_views(folder.path(), options);
        EXPECT_FALSE(views.estimated);
        EXPECT_NEAR(views.spacing, scene.spacing, 1e-12);
        EXPECT_NEAR(views.light_field.grid().half_u(), 2.5 * scene.spacing / scene.distance, 1e-9);
        EXPECT_LT(error_of(views.light_field), std::pow(10, -3.2)) << "32 dB";
    }
}

TEST(Densify, TheSignOfDisparityMatters) {
    const TestFolder folder;
    write_views(folder);
    Array<float, 3> map = map_of(2, 2);
    for (float& value : map.elements()) value = -value;
    folder.write("disp.pfm", image::pfm_file(map));
    ViewImportOptions options = options_of();
    options.densify = 2;
    EXPECT_GT(error_of(import_views(folder.path(), options).light_field), std::pow(10, -2.4));
}

TEST(Densify, AnEstimateIsAskedForAndNamed) {
    const TestFolder folder;
    write_views(folder);
    ViewImportOptions options = options_of();
    options.densify = 2;
    try {
        import_views(folder.path(), options);
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find("can be estimated"), std::string::npos);
    }
    options.estimate_disparity = true;
    const ImportedViews views = import_views(folder.path(), options);
    EXPECT_TRUE(views.estimated);
    EXPECT_LT(error_of(views.light_field), std::pow(10, -2.8)) << "28 dB";
}

TEST(Densify, TheEstimateFindsBothSurfaces) {
    const TestFolder folder;
    write_views(folder);
    const ViewSet set = open_views(folder.path(), {});
    const DisparityMap map = estimate_disparity(set, 8);
    std::size_t right = 0, pixels = 0;
    for (std::size_t y = 6; y < scene.height - 6; ++y)
        for (std::size_t x = 6; x < scene.width - 6; ++x, ++pixels)
            right += std::abs(map(y, x) - disparity_at(2, 2, y, x)) < 0.3;
    EXPECT_GT(static_cast<double>(right), 0.9 * static_cast<double>(pixels));
}

TEST(Densify, MovedMapsHideAndUncover) {
    // A card of disparity 3 before a ground of 1, seen one view to the right and two below.
    DisparityMap map({20, 30}, 1.0f);
    for (std::size_t y = 8; y < 14; ++y)
        for (std::size_t x = 12; x < 20; ++x) map(y, x) = 3;
    const DisparityMap right = moved(map, 1, 0, 1), below = moved(map, 0, 2, 0.5);
    for (std::size_t y = 9; y < 13; ++y) {
        EXPECT_EQ(right(y, 10), 3) << "three pixels to the left";
        EXPECT_EQ(right(y, 15), 3);
        EXPECT_EQ(right(y, 18), 1) << "uncovered: the ground";
        EXPECT_EQ(right(y, 7), 1);
    }
    for (std::size_t x = 13; x < 19; ++x) {
        EXPECT_EQ(below(6, x), 3) << "three pixels up";
        EXPECT_EQ(below(12, x), 1);
    }
    EXPECT_TRUE(std::ranges::equal(moved(map, 0, 0, 1).elements(), map.elements()));
}

TEST(Densify, RaysGetTheirDepth) {
    const TestFolder folder;
    write_views(folder);
    folder.write("gt_disp_lowres.pfm", image::pfm_file(map_of(2, 2)));
    ViewImportOptions options = options_of();
    options.with_depth = true;
    const LightField light_field = import_views(folder.path(), options).light_field;
    ASSERT_TRUE(light_field.front().has_depth());
    const LightFieldGrid& grid = light_field.grid();
    LightFieldBuffer buffer(grid, true);
    hogel::write_views(light_field, buffer);
    std::size_t right = 0, rays = 0;
    for (std::size_t l = 0; l < 3; ++l)
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t y = 0; y < scene.height; ++y)
                for (std::size_t x = 0; x < scene.width; ++x, ++rays) {
                    const double depth = scene.depth(scene.camera_x(2 * (2 - k)), scene.camera_y(2 * (2 - l)),
                                                     scene.pixel_x(x), scene.pixel_y(y));
                    right += std::abs(buffer.depth(y, x, l, k) - depth) < 1e-6;
                }
    // All but those at the card's edge, which rounding to whole pixels moves.
    EXPECT_GT(static_cast<double>(right), 0.95 * static_cast<double>(rays));
}

TEST(Densify, DepthMapsAreDisparityToo) {
    const TestFolder folder;
    write_views(folder);
    folder.write(
        "parameters.cfg",
        fmt::format("[intrinsics]\nfocal_length_mm: 50 ; of the lens\nimage_resolution_x_px = {}\n"
                    "image_resolution_y_px = {}\nSensor_Size_mm = {} # wide\n[extrinsics]\nbaseline_mm = {}\n"
                    "focus_distance_m = {}\n",
                    scene.width, scene.height, 50 * scene.pixel / scene.distance * static_cast<double>(scene.width),
                    2e3 * scene.spacing, scene.distance));
    Array<float, 3> depth({scene.height, scene.width, 1});
    for (std::size_t y = 0; y < scene.height; ++y)
        for (std::size_t x = 0; x < scene.width; ++x)
            depth(y, x, 0) = static_cast<float>(
                scene.distance + scene.depth(scene.camera_x(2), scene.camera_y(2), scene.pixel_x(x), scene.pixel_y(y)));
    folder.write("Depth.pfm", image::pfm_file(depth));
    const ViewSet set = open_views(folder.path(), {});
    const auto disparities = find_disparities(folder.path(), set, 4);
    ASSERT_NE(disparities, nullptr);
    const auto map = disparities->at(1, 1);
    for (std::size_t y = 0; y < scene.height; y += 7)
        for (std::size_t x = 0; x < scene.width; x += 5) ASSERT_NEAR((*map)(y, x), disparity_at(2, 2, y, x), 1e-3);
}

TEST(Densify, MapsOfWholeNumbersHaveAScale) {
    const TestFolder folder;
    write_views(folder);
    Array<std::uint16_t, 3> codes({scene.height, scene.width, 1});
    for (std::size_t y = 0; y < scene.height; ++y)
        for (std::size_t x = 0; x < scene.width; ++x)
            codes(y, x, 0) = static_cast<std::uint16_t>(std::lround(256 * (disparity_at(2, 2, y, x) + 20)));
    const float around = static_cast<float>(codes(10, 11, 0)) / 256;
    codes(10, 10, 0) = 0;  // not known
    folder.write("disp.png", image::png_file(codes.view(), {}, image::Curve::none));
    const ViewSet set = open_views(folder.path(), {});
    const auto map = find_disparities(folder.path(), set, 4, 256)->at(1, 1);
    for (std::size_t y = 0; y < scene.height; y += 7)
        for (std::size_t x = 0; x < scene.width; x += 5)
            ASSERT_NEAR((*map)(y, x), disparity_at(2, 2, y, x) + 20, 0.5 / 256 + 1e-5);
    EXPECT_FLOAT_EQ((*map)(10, 10), around);
    EXPECT_THROW(find_disparities(folder.path(), set, 4), Error);
    // A map of floating-point numbers comes first, and pictures of 8 bits are none without a scale.
    folder.write("disp.pfm", image::pfm_file(map_of(2, 2)));
    EXPECT_EQ(find_disparities(folder.path(), set, 4)->origin(), "disp.pfm");
    std::filesystem::remove(folder.path() / "disp.pfm");
    folder.write("disp.png", scene.png(2, 2));
    EXPECT_EQ(find_disparities(folder.path(), set, 4), nullptr);
    const auto error = [&] {
        try {
            find_disparities(folder.path(), set, 4, 256);
        } catch (const Error& wrong) {
            return std::string(wrong.what());
        }
        return std::string("nothing");
    };
    EXPECT_NE(error().find("disp.png: a map has one channel"), std::string::npos) << error();
    folder.write("disp.png", image::png_file(Array<std::uint16_t, 3>({scene.height, scene.width, 1}).view(), {},
                                             image::Curve::none));
    EXPECT_NE(error().find("disp.png: is a map without known pixels"), std::string::npos) << error();
}

TEST(Densify, DamagedMapsAreNamed) {
    const TestFolder folder;
    write_views(folder);
    ViewImportOptions options = options_of();
    options.densify = 2;
    const auto error = [&] {
        try {
            import_views(folder.path(), options);
        } catch (const Error& wrong) {
            return std::string(wrong.what());
        }
        return std::string("nothing");
    };
    Array<float, 3> map = map_of(2, 2);
    map(5, 5, 0) = NAN;
    folder.write("disp.pfm", image::pfm_file(map));
    EXPECT_NE(error().find("disp.pfm: holds a disparity that cannot be"), std::string::npos) << error();
    std::vector<unsigned char> bytes = image::pfm_file(map_of(2, 2));
    for (const std::size_t length : {std::size_t{0}, std::size_t{2}, std::size_t{12}, bytes.size() - 1}) {
        folder.write("disp.pfm", std::vector<unsigned char>(bytes.begin(), bytes.begin() + static_cast<long>(length)));
        EXPECT_NE(error().find("disp.pfm"), std::string::npos) << length;
    }
    folder.write("disp.pfm", bytes);
    folder.write("disp2.pfm", bytes);
    EXPECT_NE(error().find("has 2 maps of disparity or depth; expected one"), std::string::npos) << error();
    options.densify = 65;
    EXPECT_NE(error().find("factors from 1 to 64, not by 65"), std::string::npos) << error();
}

}  // namespace
}  // namespace hogel::exchange
