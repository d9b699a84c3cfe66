// SPDX-License-Identifier: Apache-2.0
// Sets with other files beside the views, names in other cases, dark edges.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "hogel/error.h"
#include "hogel/exchange/disparity.h"
#include "hogel/exchange/test_views.h"
#include "hogel/exchange/view_set.h"
#include "hogel/io/arrays/npy.h"

namespace hogel::exchange {
namespace {

const TestScene scene{.columns = 3, .rows = 3, .width = 20, .height = 18};

std::string error_of(const std::filesystem::path& source, const ViewImportOptions& options = {}) {
    try {
        import_views(source, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing";
}

TEST(SetVariations, OtherFilesBesideTheViewsAreLeftAlone) {
    for (const char* name : {"input_Cam{:03}.png", "INPUT_CAM{:03}.PNG", "Input_cam{:03}.Png"}) {
        const TestFolder folder;
        for (std::size_t i = 0; i < 9; ++i) {
            folder.write(fmt::format(fmt::runtime(name), i), scene.png(i / 3, i % 3));
            folder.write(fmt::format("._input_Cam{:03}.png", i), std::string("of another system"));
            folder.write(fmt::format("depth_{:03}.png", i), scene.png(0, 0));
            folder.write(fmt::format("depth_more_{:03}.png", i), scene.png(0, 0));
        }
        folder.write("Thumbs.db", std::string("of another system"));
        folder.write("objectids_lowres.png", scene.png(0, 0));
        std::filesystem::create_directory(folder.path() / "input_Cam009.png");
        const ViewSet set = open_views(folder.path(), {});
        EXPECT_EQ(set.layout, "hci");
        EXPECT_EQ(set.columns, 3u);
        EXPECT_EQ(set.rows, 3u);
    }
}

TEST(SetVariations, MapsAreNoViewsThoughTheyAreAsMany) {
    const TestFolder folder;
    for (std::size_t i = 0; i < 9; ++i) {
        folder.write(fmt::format("view {}é{}.png", i / 3, i % 3), scene.png(i / 3, i % 3));
        folder.write(fmt::format("a depth {}_{}.png", i / 3, i % 3), scene.png(0, 0));
    }
    folder.write("a depth 3_0.png", scene.png(0, 0));
    const ViewSet set = open_views(folder.path(), {});
    EXPECT_EQ(set.layout, "rows-columns");
    EXPECT_NE(set.pictures->name(1, 2).find("view "), std::string::npos) << set.pictures->name(1, 2);
}

// Names of a light field camera in Blender: column and row, camera position, and array size.
TEST(SetVariations, NumbersThatFollowFromOthersSayNothingOfTheOrder) {
    const TestFolder folder;
    const TestScene large{.columns = 3, .rows = 3};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            folder.write(fmt::format("Original Camera_{:02}_{:02}_{:f}_{:f}_30_36.png", 1 + 3 * column, 1 + 3 * row,
                                     90.0 - 90 * column, 90.0 * row - 90),
                         large.png(static_cast<std::size_t>(row), static_cast<std::size_t>(column)));
    const ViewSet set = open_views(folder.path(), {});
    EXPECT_EQ(set.layout, "rows-columns");
    EXPECT_EQ(set.columns, 3u);
    EXPECT_EQ(set.rows, 3u);
    EXPECT_TRUE(set.pictures->name(0, 2).find("_07_01_-90") != std::string::npos) << set.pictures->name(0, 2);
}

// Neural network software writes leading axes of extent 1.
TEST(SetVariations, ArraysOfBatchesAreViewsOrFields) {
    const TestFolder folder;
    const auto is_set = [&](const char* type, const std::vector<std::size_t>& shape) {
        std::size_t bytes = 8;
        for (const std::size_t extent : shape) bytes *= extent;
        folder.write("a.npy", io::arrays::npy_beginning(type, shape) + std::string(bytes, '\0'));
        return is_view_set(folder.path() / "a.npy");
    };
    EXPECT_TRUE(is_set("<f4", {3, 4, 8, 8, 3}));
    EXPECT_TRUE(is_set("<f4", {1, 5, 8, 8}));  // a row of views
    EXPECT_TRUE(is_set("|u1", {1, 3, 4, 8, 8, 1}));
    const ViewSet set = open_views(folder.path() / "a.npy", {});
    EXPECT_EQ(set.rows, 3u);
    EXPECT_EQ(set.columns, 4u);
    EXPECT_FALSE(is_set("<c8", {1, 5, 8, 8}));
    EXPECT_FALSE(is_set("<f4", {1, 1, 8, 8}));
    EXPECT_FALSE(is_set("<f4", {1, 3, 8, 8}));
    EXPECT_FALSE(is_set("<f4", {1, 8, 8, 2}));
    EXPECT_FALSE(is_set("<f4", {1, 1, 3, 8, 8}));
}

TEST(SetVariations, ParametersWithoutAllNumbersSayNothing) {
    const TestFolder folder;
    for (std::size_t i = 0; i < 9; ++i) folder.write(fmt::format("input_Cam{:03}.png", i), scene.png(i / 3, i % 3));
    folder.write("parameters.cfg", std::string("[intrinsics]\nfocal_length_mm = 100\n[extrinsics]\nnum_cams_x = 3\n"));
    const ImportedViews views = import_views(folder.path(), {});
    EXPECT_EQ(views.notes.front(), "parameters.cfg has no baseline_mm, so it says nothing of the geometry");
    EXPECT_EQ(views.scale, 0);
}

TEST(SetVariations, StanfordPlacesMayBeOfEitherSignAndShort) {
    const TestFolder folder;
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            folder.write(fmt::format("out_{:02}_{:02}_{}_{}{}.png", r + 7, c, 10 * static_cast<double>(r) - 10,
                                     12.5 * static_cast<double>(c) - 12.5, c == 1 ? "" : "_"),
                         scene.png(r, c));
    const ViewSet set = open_views(folder.path(), {});
    EXPECT_EQ(set.layout, "stanford");
    EXPECT_EQ(set.columns, 3u);
    EXPECT_NEAR(set.geometry.spacing_ratio, 0.8, 1e-12);
}

// A scene with enough parallax and texture to tell the order of views by.
const TestScene large{.columns = 4, .rows = 3, .width = 128, .height = 96};

// Whether each view of a set is that of the scene's camera.
void expect_views(const TestScene& of, const ViewSet& set) {
    ASSERT_EQ(set.columns, of.columns);
    ASSERT_EQ(set.rows, of.rows);
    std::size_t wrong = 0;
    for (std::size_t r = 0; r < of.rows; ++r)
        for (std::size_t c = 0; c < of.columns; ++c) {
            const image::Picture picture = set.pictures->read(r, c);
            const auto& samples = std::get<Array<std::uint8_t, 3>>(picture.samples);
            wrong += !std::ranges::equal(samples.elements(), of.view(r, c).elements());
        }
    EXPECT_EQ(wrong, 0u);
}

TEST(SetVariations, NamesOfStrangers) {
    // The set, the number of the first view, and what is beside it.
    for (const char* name :
         {"view_{:02}_{:02}.png", "My Photos {} {}.PNG", "2026-05-01 row{}col{:04}.png", "{}x{}.Png"})
        for (const std::size_t first : {0, 1, 100}) {
            const TestFolder folder;
            for (std::size_t r = 0; r < 3; ++r)
                for (std::size_t c = 0; c < 4; ++c) {
                    folder.write(fmt::format(fmt::runtime(name), r + first, c + first), large.png(r, c));
                    folder.write(fmt::format("Thumb_{}_{}.png", r, c), scene.png(0, 0));
                    folder.write(fmt::format("a preview {}_{}.png", r, c), scene.png(0, 0));
                }
            folder.write("README.txt", std::string("photographs"));
            folder.write("contact sheet.png", scene.png(0, 0));
            SCOPED_TRACE(name);
            const ViewSet set = open_views(folder.path(), {});
            EXPECT_EQ(set.layout, "rows-columns");
            expect_views(large, set);
        }
}

ViewImportOptions four_by_three() {
    ViewImportOptions options;
    options.columns = 4;
    options.rows = 3;
    return options;
}

TEST(SetVariations, NamesThatCamerasGiveAreOfCameras) {
    for (const char* name : {"Cam_{:03}.png", "IMG_{:04}.PNG", "DSC{:05}.png", "frame{}.png"}) {
        const TestFolder folder;
        for (std::size_t i = 0; i < 12; ++i)
            folder.write(fmt::format(fmt::runtime(name), i + 7), large.png(i / 4, i % 4));
        const ViewSet set = open_views(folder.path(), four_by_three());
        EXPECT_FALSE(set.geometry.orthographic) << name;
        EXPECT_EQ(set.notes.back(), "numbered views were taken for those of cameras, by their names");
        expect_views(large, set);
    }
}

TEST(SetVariations, PathsOfOneCameraAreUnwound) {
    struct Path {
        const char* note;
        std::function<std::size_t(std::size_t row, std::size_t column)> number;
    };
    const Path paths[] = {{"numbered", [](std::size_t r, std::size_t c) { return 4 * r + c; }},
                          {"every second row of views runs back",
                           [](std::size_t r, std::size_t c) { return 4 * r + (r % 2 ? 3 - c : c); }},
                          {"column by column", [](std::size_t r, std::size_t c) { return 3 * c + r; }},
                          {"every second column of views runs back",
                           [](std::size_t r, std::size_t c) { return 3 * c + (c % 2 ? 2 - r : r); }}};
    for (const Path& path : paths) {
        SCOPED_TRACE(path.note);
        const TestFolder folder;
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 4; ++c)
                folder.write(fmt::format("IMG_{:04}.png", path.number(r, c)), large.png(r, c));
        const ViewSet set = open_views(folder.path(), four_by_three());
        expect_views(large, set);
        EXPECT_TRUE(std::ranges::any_of(
            set.notes, [&](const std::string& note) { return note.find(path.note) != std::string::npos; }));
    }
}

TEST(SetVariations, NineViewsOfARailAreOneRow) {
    const TestScene rail{.columns = 9, .rows = 1, .width = 128, .height = 96};
    const TestScene square{.columns = 3, .rows = 3, .width = 128, .height = 96};
    for (const TestScene* made : {&rail, &square}) {
        const TestFolder folder;
        for (std::size_t i = 0; i < 9; ++i)
            folder.write(fmt::format("IMG_{:04}.png", i), made->png(i / made->columns, i % made->columns));
        expect_views(*made, open_views(folder.path(), {}));
    }
}

TEST(SetVariations, TwoNumberedPicturesAreASetIfTheirNumberIsGiven) {
    const TestScene pair{.columns = 2, .rows = 1};
    const TestFolder folder;
    for (std::size_t c = 0; c < 2; ++c) folder.write(fmt::format("cam_{}.png", c), pair.png(0, c));
    EXPECT_FALSE(is_view_set(folder.path()));
    EXPECT_THROW(open_views(folder.path(), {}), Error);
    ViewImportOptions options;
    options.columns = 2;
    options.rows = 1;
    expect_views(pair, open_views(folder.path(), options));
}

TEST(SetVariations, QuiltsByManyNames) {
    const TestScene row{.columns = 4, .rows = 1, .width = 20, .height = 16};
    Array<std::uint8_t, 3> quilt({32, 40, 3});
    for (std::size_t i = 0; i < 4; ++i) {
        const Array<std::uint8_t, 3> view = row.view(0, i);
        for (std::size_t y = 0; y < 16; ++y)
            std::copy_n(&view(y, 0, 0), 60, &quilt((1 - i / 2) * 16 + y, i % 2 * 20, 0));
    }
    for (const char* name :
         {"a_qs2x2a1.25.png", "a_qs2x2.png", "A_QS2x2A1.25.PNG", "a_qs2x2a1.25 (1).png", "a_qs2x2a1.25_hd.png"}) {
        const TestFolder folder;
        folder.write(name, image::png_file(quilt.view(), {}, image::Curve::srgb));
        SCOPED_TRACE(name);
        EXPECT_TRUE(is_view_set(folder.path() / name));
        const ViewSet set = open_views(folder.path() / name, {});
        expect_views(row, set);
        EXPECT_NEAR(set.geometry.pixel_height, 1, 1e-12);
    }
    // A margin is on the right and at the top.
    Array<std::uint8_t, 3> wide({33, 41, 3});
    for (std::size_t y = 0; y < 32; ++y) std::copy_n(&quilt(y, 0, 0), 120, &wide(y + 1, 0, 0));
    const TestFolder folder;
    folder.write("wide_qs2x2a1.25.png", image::png_file(wide.view(), {}, image::Curve::srgb));
    expect_views(row, open_views(folder.path() / "wide_qs2x2a1.25.png", {}));
    folder.write("a_qs2xa1.png", row.png(0, 0));
    EXPECT_NE(error_of(folder.path() / "a_qs2xa1.png").find("a_qs2xa1.png: is no set"), std::string::npos);
}

TEST(SetVariations, ThreeNumbersAreTooMany) {
    const TestFolder folder;
    for (std::size_t i = 0; i < 9; ++i)
        folder.write(fmt::format("{}_{}_{}.png", i / 3, i % 3, 1000 + 7 * i), scene.png(i / 3, i % 3));
    EXPECT_NE(error_of(folder.path()).find("the names of 9 pictures such as 0_0_1000.png differ in 3 numbers"),
              std::string::npos)
        << error_of(folder.path());
}

TEST(SetVariations, AMapOfTheMiddleMayLieBesideThoseOfAllViews) {
    const TestFolder folder;
    const Array<float, 3> flat({scene.height, scene.width, 1}, 0.25f), other({scene.height, scene.width, 1}, 0.5f);
    for (std::size_t i = 0; i < 9; ++i) {
        folder.write(fmt::format("input_Cam{:03}.png", i), scene.png(i / 3, i % 3));
        folder.write(fmt::format("gt_disp_lowres_Cam{:03}.pfm", i), image::pfm_file(flat));
    }
    folder.write("gt_disp_lowres.pfm", image::pfm_file(other));
    const auto disparities = find_disparities(folder.path(), open_views(folder.path(), {}), 4);
    ASSERT_NE(disparities, nullptr);
    EXPECT_EQ((*disparities->at(0, 2))(3, 3), 0.25f);
    EXPECT_EQ((*disparities->at(1, 1))(3, 3), 0.25f);
}

TEST(SetVariations, ASetInAFolderBelowIsNamed) {
    const TestFolder folder;
    std::filesystem::create_directories(folder.path() / "rectified");
    for (std::size_t i = 0; i < 9; ++i)
        folder.write(fmt::format("rectified/{}_{}.png", i / 3, i % 3), scene.png(i / 3, i % 3));
    EXPECT_NE(error_of(folder.path()).find("rectified is one"), std::string::npos) << error_of(folder.path());
}

TEST(SetVariations, TheMiddleIsTakenAlone) {
    const TestScene five{.columns = 5, .rows = 5, .width = 20, .height = 18};
    const TestFolder folder;
    const auto write = [&](std::size_t r, std::size_t c, bool dark) {
        Array<std::uint8_t, 3> view = five.view(r, c);
        for (std::uint8_t& code : view.elements())
            if (dark) code /= 4;
        folder.write(fmt::format("{}_{}.png", r, c), image::png_file(view.view(), {}, image::Curve::srgb));
    };
    for (std::size_t r = 0; r < 5; ++r)
        for (std::size_t c = 0; c < 5; ++c) write(r, c, r == 4 && c == 4);
    ViewImportOptions options;
    options.column_first = false;
    const auto dark_notes = [&] {
        const ImportedViews views = import_views(folder.path(), options);
        return std::ranges::count_if(views.notes, [](const std::string& note) {
            return note.find("4_4.png has 2") != std::string::npos &&
                   note.find(" % of the middle view's mean; the middle 3x3 or fewer") != std::string::npos;
        });
    };
    EXPECT_EQ(dark_notes(), 1);
    options.middle_columns = options.middle_rows = 3;
    EXPECT_EQ(dark_notes(), 0);
    const ViewSet set = open_views(folder.path(), options);
    EXPECT_EQ(set.columns, 3u);
    EXPECT_NE(set.pictures->name(0, 2).find("1_3.png"), std::string::npos) << set.pictures->name(0, 2);
    for (const std::size_t wrong : {2, 7}) {
        options.middle_columns = wrong;
        EXPECT_NE(error_of(folder.path(), options).find("of 5x5 views were asked for"), std::string::npos);
    }
}

}  // namespace
}  // namespace hogel::exchange
