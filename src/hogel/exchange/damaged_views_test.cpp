// SPDX-License-Identifier: Apache-2.0
// Damaged sets are rejected with the name of the damaged file.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sys/stat.h>

#include "hogel/error.h"
#include "hogel/exchange.h"
#include "hogel/exchange/file_names.h"
#include "hogel/exchange/test_views.h"

namespace hogel::exchange {
namespace {

const TestScene scene{.columns = 3, .rows = 3, .width = 20, .height = 18};

// A set of the layout rows-columns.
void write_set(const TestFolder& folder) {
    for (std::size_t r = 0; r < scene.rows; ++r)
        for (std::size_t c = 0; c < scene.columns; ++c)
            folder.write(fmt::format("{:02}_{:02}.png", r, c), scene.png(r, c));
}

// The error of importing the set and reading it.
std::string error_of(const std::filesystem::path& source, const ViewImportOptions& options = {},
                     ErrorCode expected = ErrorCode::bad_input) {
    try {
        const ImportedViews views = import_views(source, options);
        LightFieldBuffer buffer(views.light_field.grid());
        write_views(views.light_field, buffer);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), expected) << error.what();
        return error.what();
    }
    return "nothing";
}

TEST(DamagedViews, AHoleIsNamed) {
    const TestFolder folder;
    write_set(folder);
    std::filesystem::remove(folder.path() / "01_02.png");
    EXPECT_NE(error_of(folder.path()).find("01_02.png: a view is missing"), std::string::npos)
        << error_of(folder.path());
}

// Memory was reserved for every pair of the numbers.
TEST(DamagedViews, NumbersThatAllDifferMakeNoGridOfTheirSquare) {
    constexpr std::int64_t count = 50000;
    NumberedFiles group;
    for (std::int64_t i = 0; i < count; ++i)
        group.files.push_back({std::filesystem::path("set") / fmt::format("{}_{}.png", i, i), {i, i}});
    try {
        in_rows_and_columns(group, 0, 1);
        ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()), "set/0_1.png: a view is missing; there are 50000 of 50000x50000");
    }
    for (std::size_t i = 0; i < group.files.size(); ++i) group.files[i].numbers[0] = 7;
    const PictureGrid row = in_rows_and_columns(group, 0, 1);
    EXPECT_EQ(row.rows, 1u);
    EXPECT_EQ(row.files[group.files.size() - 1].filename(), "49999_49999.png");
}

TEST(DamagedViews, AMissingRowIsNoticed) {
    const TestFolder folder;
    write_set(folder);
    for (std::size_t c = 0; c < 3; ++c) {
        folder.write(fmt::format("04_{:02}.png", c), scene.png(0, c));
    }
    EXPECT_NE(error_of(folder.path()).find("go on from 2 to 4"), std::string::npos) << error_of(folder.path());
}

TEST(DamagedViews, AnotherSizeIsNamed) {
    const TestFolder folder;
    write_set(folder);
    const TestScene other{.columns = 3, .rows = 3, .width = 21, .height = 18};
    folder.write("02_00.png", other.png(2, 0));
    EXPECT_NE(error_of(folder.path()).find("02_00.png: has 21x18 pixels"), std::string::npos)
        << error_of(folder.path());
}

TEST(DamagedViews, OtherChannelsAndBitsAreNamed) {
    const TestFolder folder;
    write_set(folder);
    folder.write("02_00.png", image::png_file(scene.view(2, 0, 1), {}, image::Curve::srgb));
    EXPECT_NE(error_of(folder.path()).find("02_00.png: has 1 channels"), std::string::npos) << error_of(folder.path());
    folder.write("02_00.png", image::png_file(Array<std::uint16_t, 3>({18, 20, 3}).view(), {}, image::Curve::srgb));
    EXPECT_NE(error_of(folder.path()).find("02_00.png: has 16 bits"), std::string::npos) << error_of(folder.path());
}

TEST(DamagedViews, ADamagedPictureIsNamed) {
    const TestFolder folder;
    write_set(folder);
    std::vector<unsigned char> bytes = scene.png(2, 2);
    bytes.resize(bytes.size() / 2);
    folder.write("02_02.png", bytes);
    EXPECT_NE(error_of(folder.path()).find("02_02.png"), std::string::npos) << error_of(folder.path());
}

TEST(DamagedViews, SamplesThatAreNotFiniteAreNamed) {
    const TestFolder folder;
    for (std::size_t i = 0; i < 4; ++i) {
        Array<float, 3> view({4, 4, 1}, 0.5f);
        if (i == 3) view(2, 2, 0) = NAN;
        folder.write(fmt::format("{}_{}.pfm", i / 2, i % 2), image::pfm_file(view));
    }
    EXPECT_NE(error_of(folder.path()).find("1_1.pfm: holds a sample that is not finite"), std::string::npos);
}

TEST(DamagedViews, NamesOfNoSetAreRefused) {
    const TestFolder folder;
    folder.write("alone.png", scene.png(0, 0));
    EXPECT_FALSE(is_view_set(folder.path()));
    EXPECT_NE(error_of(folder.path()).find("is no set of views"), std::string::npos);
    EXPECT_NE(error_of(folder.path() / "nothing").find("is no set of views"), std::string::npos);
    ViewImportOptions options;
    options.layout = "hci";
    EXPECT_NE(error_of(folder.path(), options).find("has no pictures input_Cam000.png"), std::string::npos);
    options.layout = "zoo";
    EXPECT_NE(error_of(folder.path(), options, ErrorCode::usage).find("no layout 'zoo'"), std::string::npos);
}

TEST(DamagedViews, CountsThatDoNotFitAreRefused) {
    const TestFolder folder;
    for (std::size_t i = 0; i < 7; ++i) folder.write(fmt::format("input_Cam{:03}.png", i), scene.png(0, i % 3));
    const std::string error = error_of(folder.path(), {}, ErrorCode::usage);
    EXPECT_NE(error.find("7 pictures such as input_Cam000.png are not as many rows as columns"), std::string::npos);
    EXPECT_EQ(error.find(folder.path().string() + ": "), 0u) << error;
    ViewImportOptions options;
    options.columns = 4;
    options.rows = 2;
    EXPECT_NE(error_of(folder.path(), options, ErrorCode::usage).find("4x2 views were asked for"), std::string::npos);
    std::filesystem::remove(folder.path() / "input_Cam003.png");
    EXPECT_NE(error_of(folder.path()).find("input_Cam003.png: a view is missing"), std::string::npos);
}

TEST(DamagedViews, ParametersWithoutANumberAreNamed) {
    const TestFolder folder;
    for (std::size_t i = 0; i < 4; ++i) folder.write(fmt::format("input_Cam{:03}.png", i), scene.png(0, i % 3));
    folder.write("parameters.cfg", std::string("[intrinsics]\nfocal_length_mm = -1\n"));
    EXPECT_NE(error_of(folder.path()).find("parameters.cfg: has no"), std::string::npos);
}

TEST(DamagedViews, ParametersThatContradictPicturesAreRefused) {
    const TestFolder folder;
    for (std::size_t i = 0; i < 4; ++i) folder.write(fmt::format("input_Cam{:03}.png", i), scene.png(0, i % 3));
    folder.write("parameters.cfg", std::string("image_resolution_x_px = 40\nimage_resolution_y_px = 18\n"));
    EXPECT_NE(error_of(folder.path()).find("parameters.cfg: says pictures of 40x18 pixels, but they have 20x18"),
              std::string::npos);
    // Directions that no grid has.
    folder.write("parameters.cfg", std::string("image_resolution_x_px = 20\nimage_resolution_y_px = 18\n"
                                               "baseline_mm = 1e308\nfocus_distance_m = 1e-12\nsensor_size_mm = 35\n"
                                               "focal_length_mm = 50\n"));
    EXPECT_NE(error_of(folder.path()).find("input_Cam000.png: "), std::string::npos) << error_of(folder.path());
    folder.write("parameters.cfg", std::string("num_cams_x = 9\nnum_cams_y = 9\n"));
    EXPECT_NE(error_of(folder.path()).find("parameters.cfg: says 9x9 cameras, but there are 4 pictures"),
              std::string::npos);
}

// It was read for ever.
TEST(DamagedViews, ParametersThatArePipesAreRefused) {
    const TestFolder folder;
    for (std::size_t i = 0; i < 4; ++i) folder.write(fmt::format("input_Cam{:03}.png", i), scene.png(0, i % 3));
    ASSERT_EQ(mkfifo((folder.path() / "parameters.cfg").c_str(), 0600), 0);
    EXPECT_NE(error_of(folder.path()).find("parameters.cfg: is not a regular file"), std::string::npos);
    std::filesystem::remove(folder.path() / "parameters.cfg");
    folder.write("parameters.cfg", std::string((1 << 20) + 1, ' '));
    EXPECT_NE(error_of(folder.path()).find("is larger than the 1048576 bytes that are read"), std::string::npos);
}

// Six pixels became 3,200,000 rows of hogels.
TEST(DamagedViews, QuiltsOfImpossiblePixelsAreRefused) {
    const TestFolder folder;
    for (const char* name : {"q_qs1x1a1e-5.png", "q_qs1x1a1e300.png", "q_qs1x1a0.1.png"}) {
        folder.write(name, scene.png(0, 0));
        EXPECT_NE(error_of(folder.path() / name).find(std::string(name) + ": says that its pixels are"),
                  std::string::npos);
    }
}

TEST(DamagedViews, OptionsThatContradictAreRefused) {
    const TestFolder folder;
    write_set(folder);
    ViewImportOptions options;
    options.spacing = 0.01;
    options.field_of_view = 0.1;
    error_of(folder.path(), options, ErrorCode::usage);
    options = {};
    options.orthographic = true;
    options.distance = 0.3;
    error_of(folder.path(), options, ErrorCode::usage);
    options = {};
    options.disparity = 15;  // leaves nothing
    error_of(folder.path(), options, ErrorCode::usage);
}

TEST(DamagedViews, ArraysAreRefusedAtEveryLength) {
    const TestFolder folder;
    std::string npy("\x93NUMPY\x01\x00\x46\x00", 10);
    npy += "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 2, 3, 3, 1), } ";
    npy += "\n" + std::string(36, 'x');
    folder.write("a.npy", npy);
    EXPECT_TRUE(is_view_set(folder.path() / "a.npy"));
    EXPECT_EQ(error_of(folder.path() / "a.npy"), "nothing");
    ViewImportOptions options;
    options.layout = "npy";
    for (std::size_t length = 0; length < npy.size(); ++length) {
        folder.write("a.npy", npy.substr(0, length));
        EXPECT_FALSE(is_view_set(folder.path() / "a.npy")) << length;
        EXPECT_NE(error_of(folder.path() / "a.npy", options), "nothing") << length;
    }
}

}  // namespace
}  // namespace hogel::exchange
