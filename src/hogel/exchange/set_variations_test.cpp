// SPDX-License-Identifier: Apache-2.0
// Sets as they are found: with other files beside their views, names in other cases, rims that are dark.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>

#include "hogel/error.h"
#include "hogel/exchange/test_views.h"
#include "hogel/exchange/view_set.h"

namespace hogel::exchange {
namespace {

const TestScene scene{.columns = 3, .rows = 3, .width = 20, .height = 18};

std::string error_of(const std::filesystem::path& source, const ViewOptions& options = {}) {
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
    ViewOptions options;
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
