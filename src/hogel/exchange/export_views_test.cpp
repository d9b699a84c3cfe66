// SPDX-License-Identifier: Apache-2.0
// What is exported is imported back: geometry, and every sample to the last bit where the format holds it.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>

#include <random>

#include "hogel/error.h"
#include "hogel/exchange.h"
#include "hogel/exchange/test_views.h"
#include "hogel/exchange/transfer.h"
#include "hogel/exchange/view_set.h"
#include "hogel/image/picture_bytes.h"

namespace hogel::exchange {
namespace {

LightFieldGrid grid_of_cameras(std::size_t rows) {
    LightFieldGrid grid{12, 9, 0.5e-3, 4, rows, Perspective{}, 3};
    grid.view = FocalPlane{{0.07, rows > 1 ? 0.05 : 0.07, 0, 0}, -0.3};
    return grid;
}

// Codes of so many bits, all different where there are enough, as linear light.
LightField random_codes(const LightFieldGrid& grid, unsigned bits, Transfer transfer) {
    auto buffer = std::make_shared<LightFieldBuffer>(grid);
    std::mt19937 random(1);
    for (float& value : buffer->radiance.elements()) {
        const auto max = static_cast<float>((1u << bits) - 1);
        value = decode(transfer, static_cast<float>(random() % (1u << bits)) / max);
    }
    return LightField(std::shared_ptr<LightFieldSource>(buffer));
}

void expect_same(const LightField& before, const LightField& after, float tolerance) {
    ASSERT_EQ(before.grid().hogels_s, after.grid().hogels_s);
    ASSERT_EQ(before.grid().directions_v, after.grid().directions_v);
    EXPECT_NEAR(before.grid().half_u(), after.grid().half_u(), 1e-10);
    EXPECT_NEAR(before.grid().pitch, after.grid().pitch, 1e-15);
    LightFieldBuffer a(before.grid()), b(after.grid());
    copy(before.front(), a);
    write_views(after, b);
    float worst = 0;
    for (std::size_t i = 0; i < a.radiance.size(); ++i)
        worst = std::max(worst, std::abs(a.radiance.data()[i] - b.radiance.data()[i]));
    EXPECT_LE(worst, tolerance);
}

ViewOptions geometry_of(const LightFieldGrid& grid) {
    ViewOptions options;
    options.size = grid.width();
    options.distance = 0.3;
    options.spacing = grid.step_u() * 0.3;
    return options;
}

struct Case {
    const char *layout, *format;
    unsigned bits;
    Transfer transfer;
};

class EveryFormat : public ::testing::TestWithParam<Case> {};

TEST_P(EveryFormat, ComesBackToTheLastBit) {
    const Case& c = GetParam();
    const LightFieldGrid grid = grid_of_cameras(3);
    const LightField before = random_codes(grid, c.bits == 32 ? 20 : c.bits, c.transfer);
    const TestFolder folder;
    ViewExportOptions options;
    options.layout = c.layout;
    options.format = c.format;
    if (c.bits != 32) options.bits = c.bits;
    options.transfer = c.transfer;
    const std::filesystem::path target = std::string(c.layout) == "npy" ? folder.path() / "a.npy" : folder.path();
    const ExportedViews exported = export_views(before, target, options);
    EXPECT_EQ(exported.columns, 4u);
    ViewOptions back = geometry_of(grid);
    back.layout = c.layout;
    back.transfer = c.transfer;
    back.column_first = false;
    back.columns = 4;
    back.rows = 3;
    back.orthographic = false;
    const ImportedViews after = import_views(target, back);
    EXPECT_EQ(after.bits, c.bits);
    expect_same(before, after.light_field, 0);
}

INSTANTIATE_TEST_SUITE_P(
    ExportViews, EveryFormat,
    ::testing::Values(Case{"hci", "png", 8, Transfer::srgb}, Case{"stanford", "png", 16, Transfer::srgb},
                      Case{"rows-columns", "ppm", 10, Transfer::srgb},
                      Case{"rows-columns", "ppm", 12, Transfer::rec709},
                      Case{"rows-columns", "ppm", 16, Transfer::gamma22}, Case{"numbered", "pfm", 32, Transfer::linear},
                      Case{"npy", "", 8, Transfer::srgb}, Case{"npy", "", 16, Transfer::linear}),
    [](const auto& test) { return fmt::format("{}_{}_{}", test.index, test.param.format, test.param.bits); });

TEST(ExportViews, HciParametersBringTheGeometryBack) {
    const LightFieldGrid grid = grid_of_cameras(4);
    LightFieldGrid square = grid;
    square.range().half_v = square.range().half_u;  // parameters.cfg has one baseline
    const LightField before = random_codes(square, 8, Transfer::srgb);
    const TestFolder folder;
    export_views(before, folder.path(), {.layout = "hci"});
    ViewOptions back;
    back.size = grid.width();
    const ImportedViews after = import_views(folder.path(), back);
    EXPECT_TRUE(after.assumed.empty());
    EXPECT_NEAR(after.distance, 0.3, 1e-12);
    expect_same(before, after.light_field, 0);
}

TEST(ExportViews, CamerasBringTheGeometryBackOffCentreToo) {
    LightFieldGrid grid = grid_of_cameras(3);
    grid.range().center_u = 0.021;
    grid.range().center_v = -0.034;
    const LightField before = random_codes(grid, 8, Transfer::srgb);
    const TestFolder folder;
    export_views(before, folder.path(), {.layout = "transforms"});
    ViewOptions back;
    back.size = grid.width();
    const ImportedViews after = import_views(folder.path(), back);
    EXPECT_TRUE(after.assumed.empty());
    EXPECT_NEAR(after.distance, 0.3, 1e-9);
    EXPECT_NEAR(after.light_field.grid().center_u(), 0.021, 1e-9);
    EXPECT_NEAR(after.light_field.grid().center_v(), -0.034, 1e-9);
    EXPECT_NEAR(after.light_field.grid().half_v(), grid.half_v(), 1e-9);
    expect_same(before, after.light_field, 0);
    // The cameras alone are the same file, before there are pictures.
    write_cameras(grid, folder.path() / "cameras.json");
    const auto text = [&](const char* name) {
        std::ifstream stream(folder.path() / name);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    EXPECT_EQ(text("cameras.json"), text("transforms.json"));
    grid.view = Perspective{};
    grid.range().half_u = grid.range().half_v = 0.1;
    EXPECT_THROW(write_cameras(grid, folder.path() / "no.json"), Error);
}

TEST(ExportViews, PicturesSayWhatMadeThem) {
    const LightField light_field =
        random_codes(grid_of_cameras(3), 8, Transfer::srgb).with(Provenance{{{"scene", "a ball"}}, {}});
    const TestFolder folder;
    export_views(light_field, folder.path(), {.metadata = {{"command", "export"}}});
    for (const char* name : {"000_000.png", "002_003.png"}) {
        const Metadata texts = image::read_picture(folder.path() / name, max_pixels).texts;
        EXPECT_EQ(std::ranges::count(texts, Metadata::value_type{"command", "export"}), 1) << name;
        EXPECT_EQ(std::ranges::count(texts, Metadata::value_type{"source scene", "a ball"}) +
                      std::ranges::count(texts, Metadata::value_type{"scene", "a ball"}),
                  1)
            << name;
    }
}

TEST(ExportViews, QuiltsComeBack) {
    const LightFieldGrid grid = grid_of_cameras(1);
    const LightField before = random_codes(grid, 8, Transfer::srgb);
    const TestFolder folder;
    const std::filesystem::path file = folder.path() / "a_qs2x2a1.3333.png";
    export_views(before, file, {.layout = "quilt", .format = "png"});
    expect_same(before, import_views(file, geometry_of(grid)).light_field, 0);
    // Four in a row are a quilt too, but three in a row would lose one.
    const std::filesystem::path row = folder.path() / "a_qs4x1a1.3333.png";
    export_views(before, row, {.layout = "quilt", .format = "png"});
    expect_same(before, import_views(row, geometry_of(grid)).light_field, 0);
    EXPECT_THROW(export_views(before, folder.path() / "a_qs3x1a1.3333.png", {.layout = "quilt"}), Error);
    EXPECT_THROW(export_views(random_codes(grid_of_cameras(3), 8, Transfer::srgb), file, {.layout = "quilt"}), Error);
}

TEST(ExportViews, OrthographicViewsComeBackAndAreNoCameras) {
    LightFieldGrid grid = grid_of_cameras(3);
    grid.view = Perspective{{0.1, 0.075, 0, 0}, Face::front};
    const LightField before = random_codes(grid, 8, Transfer::srgb);
    const TestFolder folder;
    EXPECT_THROW(export_views(before, folder.path(), {.layout = "hci"}), Error);
    export_views(before, folder.path(), {.layout = "numbered"});
    ViewOptions back;
    back.size = grid.width();
    back.columns = 4;
    back.rows = 3;
    back.field_of_view = 2 * std::atan(0.1);
    expect_same(before, import_views(folder.path(), back).light_field, 0);
}

TEST(ExportViews, ViewsInGroupsAreTheSameFiles) {
    const LightField light_field = random_codes(grid_of_cameras(3), 8, Transfer::srgb);
    const TestFolder folder;
    std::filesystem::create_directory(folder.path() / "a");
    std::filesystem::create_directory(folder.path() / "b");
    export_views(light_field, folder.path() / "a", {});
    export_views(light_field, folder.path() / "b", {.memory = 12 * 9 * 3 * 4 * 2.5});
    for (const auto& file : std::filesystem::directory_iterator(folder.path() / "a")) {
        std::ifstream one(file.path(), std::ios::binary),
            two(folder.path() / "b" / file.path().filename(), std::ios::binary);
        EXPECT_EQ(std::string(std::istreambuf_iterator<char>(one), {}),
                  std::string(std::istreambuf_iterator<char>(two), {}));
    }
}

// ITU-R BT.709-6: E = 1 is 1, E = 0.018 is 0.081; IEC 61966-2-1: code 188 of 255 is about half the light.
TEST(Transfers, HaveThePublishedValuesAndInverses) {
    EXPECT_NEAR(encode(Transfer::rec709, 0.018f), 0.081, 1e-3);
    EXPECT_NEAR(encode(Transfer::rec709, 0.5f), 0.7055, 1e-3);
    EXPECT_NEAR(decode(Transfer::srgb, 188.0f / 255), 0.5029, 1e-3);
    EXPECT_NEAR(decode(Transfer::gamma22, 0.5f), 0.21764, 1e-4);
    for (const Transfer transfer : {Transfer::srgb, Transfer::linear, Transfer::rec709, Transfer::gamma22})
        for (int code = 0; code <= 65535; code += 7)
            ASSERT_EQ(std::lround(65535 * encode(transfer, decode(transfer, static_cast<float>(code) / 65535))), code)
                << transfer_names()[static_cast<std::size_t>(transfer)];
}

}  // namespace
}  // namespace hogel::exchange
