// SPDX-License-Identifier: Apache-2.0
// Round trip of export and import: geometry, and all samples exactly if the format can hold them.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <numeric>
#include <random>

#include "hogel/error.h"
#include "hogel/exchange.h"
#include "hogel/exchange/scaled_view.h"
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

// Codes of the given number of bits, distinct if possible, as linear light.
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

ViewImportOptions geometry_of(const LightFieldGrid& grid) {
    ViewImportOptions options;
    options.size = grid.width();
    options.distance = 0.3;
    options.spacing = grid.step_u() * 0.3;
    return options;
}

// Random codes of 8 bits, and an empty folder for them.
struct EightBits {
    explicit EightBits(const LightFieldGrid& made_of) : grid(made_of) {}
    explicit EightBits(std::size_t rows = 3) : EightBits(grid_of_cameras(rows)) {}

    ViewImportOptions size() const {
        ViewImportOptions options;
        options.size = grid.width();
        return options;
    }

    LightFieldGrid grid;
    LightField light_field = random_codes(grid, 8, Transfer::srgb);
    TestFolder folder;
};

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
    const std::string layout = c.layout;
    const std::filesystem::path target =
        view_layouts().find(layout).is_folder ? folder.path() : folder.path() / ("a." + layout);
    const ExportedViews exported = export_views(before, target, options);
    EXPECT_EQ(exported.columns, 4u);
    ViewImportOptions back = geometry_of(grid);
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
                      Case{"npy", "", 8, Transfer::srgb}, Case{"npy", "", 16, Transfer::linear},
                      Case{"mat", "", 8, Transfer::srgb}, Case{"mat", "", 16, Transfer::linear}),
    [](const auto& test) { return fmt::format("{}_{}_{}", test.index, test.param.format, test.param.bits); });

TEST(ExportViews, HciParametersBringTheGeometryBack) {
    LightFieldGrid square = grid_of_cameras(4);
    square.range().half_v = square.range().half_u;  // parameters.cfg has one baseline
    const EightBits before(square);
    export_views(before.light_field, before.folder.path(), {.layout = "hci"});
    const ImportedViews after = import_views(before.folder.path(), before.size());
    EXPECT_TRUE(after.assumed.empty());
    EXPECT_NEAR(after.distance, 0.3, 1e-12);
    expect_same(before.light_field, after.light_field, 0);
}

TEST(ExportViews, CamerasBringTheGeometryBackOffCentreToo) {
    LightFieldGrid grid = grid_of_cameras(3);
    grid.range().center_u = 0.021;
    grid.range().center_v = -0.034;
    const EightBits before(grid);
    const std::filesystem::path folder = before.folder.path();
    const ExportedViews exported = export_views(before.light_field, folder, {.layout = "transforms"});
    const ImportedViews after = import_views(folder, before.size());
    EXPECT_TRUE(after.assumed.empty());
    EXPECT_NEAR(after.distance, 0.3, 1e-9);
    EXPECT_NEAR(after.light_field.grid().center_u(), 0.021, 1e-9);
    EXPECT_NEAR(after.light_field.grid().center_v(), -0.034, 1e-9);
    EXPECT_NEAR(after.light_field.grid().half_v(), grid.half_v(), 1e-9);
    expect_same(before.light_field, after.light_field, 0);
    // The outermost camera's centre: (1.5 of 4 steps of 2 x 0.07, and 0.021) x 0.3 m / 0.5 mm beside the middle.
    ASSERT_EQ(exported.notes.size(), 1u);
    EXPECT_TRUE(exported.notes[0].starts_with("pictures are off centre by up to 44.1 pixels across and 40.4 down"))
        << exported.notes[0];
    // The cameras alone are the same file, before there are pictures.
    EXPECT_EQ(write_cameras(grid, folder / "cameras.json"), exported.notes);
    const auto text = [&](const char* name) {
        std::ifstream stream(folder / name);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    EXPECT_EQ(text("cameras.json"), text("transforms.json"));
    grid.view = Perspective{};
    grid.range().half_u = grid.range().half_v = 0.1;
    EXPECT_THROW(write_cameras(grid, folder / "no.json"), Error);
}

TEST(ExportViews, PicturesSayWhatMadeThem) {
    const EightBits made;
    const LightField light_field = made.light_field.with(Provenance{{{"scene", "a ball"}}, {}});
    export_views(light_field, made.folder.path(), {.metadata = {{"command", "export"}}});
    for (const char* name : {"000_000.png", "002_003.png"}) {
        const Metadata texts = image::read_picture(made.folder.path() / name, max_pixels).texts;
        EXPECT_EQ(std::ranges::count(texts, Metadata::value_type{"command", "export"}), 1) << name;
        EXPECT_EQ(std::ranges::count(texts, Metadata::value_type{"source scene", "a ball"}) +
                      std::ranges::count(texts, Metadata::value_type{"scene", "a ball"}),
                  1)
            << name;
    }
}

TEST(ExportViews, FloatingPointArraysComeBack) {
    const EightBits made;
    const LightField before =
        made.light_field.with(Provenance{{{"views bits", "32"}, {"views transfer", "linear"}}, {}});
    for (const char* layout : {"npy", "mat"}) {
        const std::filesystem::path file = made.folder.path() / fmt::format("a.{}", layout);
        export_views(before, file, {.layout = layout});
        ViewImportOptions back = geometry_of(made.grid);
        back.column_first = false;
        const ImportedViews after = import_views(file, back);
        EXPECT_EQ(after.bits, 32u);
        expect_same(before, after.light_field, 0);
    }
}

TEST(ExportViews, QuiltsComeBack) {
    const EightBits before(1);
    const std::filesystem::path folder = before.folder.path();
    // Four in a row are a quilt too, but three in a row would lose one.
    for (const char* name : {"a_qs2x2a1.3333.png", "a_qs4x1a1.3333.png"}) {
        export_views(before.light_field, folder / name, {.layout = "quilt", .format = "png"});
        expect_same(before.light_field, import_views(folder / name, geometry_of(before.grid)).light_field, 0);
    }
    EXPECT_THROW(export_views(before.light_field, folder / "a_qs3x1a1.3333.png", {.layout = "quilt"}), Error);
}

TEST(ExportViews, QuiltsAreTheMiddleRowOfViews) {
    const EightBits all, row(1);
    const std::filesystem::path file = all.folder.path() / "a_qs2x2a1.3333.png";
    const ExportedViews exported = export_views(all.light_field, file, {.layout = "quilt"});
    EXPECT_EQ(exported.rows, 1u);
    EXPECT_EQ(exported.notes, std::vector<std::string>{"one row of cameras: row 2 of the 3 rows of views"});
    LightFieldBuffer before(all.grid), after(row.grid);
    copy(all.light_field.front(), before);
    write_views(import_views(file, geometry_of(row.grid)).light_field, after);
    for (std::size_t t = 0; t < 9; ++t)
        for (std::size_t s = 0; s < 12; ++s)
            for (std::size_t k = 0; k < 4; ++k)
                ASSERT_EQ(after.radiance(0, t, s, 0, k), before.radiance(0, t, s, 1, k));
}

// A bright bar at a depth, and the display that shows it in tiles of 20x20 pixels with margins.
struct BarQuilt {
    static constexpr double distance = 0.3, size = 40e-3;
    QuiltDisplay display{"test", 3, 2, 62, 41, 1.25, 0.3, ""};
    LightFieldGrid grid{50, 40, size / 50, 6, 1, FocalPlane{{0.15, 0.15 / 6}, -distance}, 3};

    // Returns the codes of the quilt.
    Array<std::uint8_t, 3> write(double depth) const {
        const LightField light_field = light_field_from(
            grid, [=](double s, double, double U, double) { return std::abs(s + U * depth) < 2e-3 ? 0.1 : 0.0; });
        const TestFolder folder;
        const std::filesystem::path file = folder.path() / "bar_qs3x2a1.25.png";
        export_views(light_field, file, {.layout = "quilt", .exposure = 0, .display = display});
        return std::get<Array<std::uint8_t, 3>>(image::read_picture(file, max_pixels).samples);
    }
    // Returns the position of the bar in view i, in pixels of its tile.
    static double bar(const Array<std::uint8_t, 3>& quilt, std::size_t i) {
        double sum = 0, moment = 0;
        for (std::size_t x = 0; x < 20; ++x) {
            const double light =
                decode(Transfer::srgb, static_cast<float>(quilt(41 - 10 - i / 3 * 20, i % 3 * 20 + x, 0)) / 255);
            sum += light;
            moment += light * (static_cast<double>(x) + 0.5);
        }
        return moment / sum;
    }
};

// From a camera to the one on its right, a point at depth ζ moves by bζ/(D + ζ) to the right, a near one to the left.
TEST(ExportViews, QuiltsForADisplayHaveItsSizeAndOrderAndTheParallaxOfDepth) {
    const BarQuilt made;
    const double spacing = made.grid.step_u() * BarQuilt::distance, pixel = BarQuilt::size / 20;
    for (const double depth : {-0.03, 0.05}) {
        const Array<std::uint8_t, 3> quilt = made.write(depth);
        ASSERT_EQ(quilt.shape(), (Shape<3>{41, 62, 3}));
        const double step = spacing * depth / (BarQuilt::distance + depth) / pixel;
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_NEAR(BarQuilt::bar(quilt, i), 10 + (static_cast<double>(i) - 2.5) * step, 0.25) << depth << " " << i;
        for (std::size_t x = 0; x < 62; ++x) EXPECT_EQ(quilt(0, x, 0), 0) << "margin at the top";
        for (std::size_t y = 0; y < 41; ++y) EXPECT_EQ(quilt(y, 60, 0) + quilt(y, 61, 0), 0) << "margin on the right";
        // The median of the middle view becomes 0.55.
        EXPECT_NEAR(*std::ranges::max_element(quilt.elements()), 255 * encode(Transfer::srgb, 0.55f), 1);
    }
}

TEST(ExportViews, QuiltsForADisplayNeedItsViewsAspectAndName) {
    const BarQuilt made;
    const LightField light_field = light_field_from(made.grid, [](double, double, double, double) { return 0.1; });
    const TestFolder folder;
    const auto refuses = [&](const QuiltDisplay& display, const char* name) {
        EXPECT_THROW(export_views(light_field, folder.path() / name, {.layout = "quilt", .display = display}), Error)
            << name;
    };
    refuses(made.display, "bar.png");
    refuses(made.display, "bar_qs2x3a1.25.png");
    refuses(made.display, "bar_qs3x2a1.png");
    refuses({"wide", 3, 2, 60, 40, 1.5, 0.3, ""}, "bar_qs3x2a1.5.png");
    refuses({"more", 4, 2, 60, 40, 1.25, 0.3, ""}, "bar_qs4x2a1.25.png");
    refuses({"none", 0, 0, 0, 0, 1.25, 0.3, ""}, "bar_qs3x2a1.25.png");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// Device templates of https://github.com/Looking-Glass/LKG-Toolkit, but for the 16" landscape, which reports these.
TEST(QuiltDisplays, HaveTheFiguresOfTheirMaker) {
    struct Figures {
        const char* name;
        std::size_t width, height, columns, rows, tile_width, tile_height;
        double screen_width, screen_height;
    };
    for (const Figures& f : {Figures{"lkg-portrait", 3360, 3360, 8, 6, 420, 560, 1536, 2048},
                             Figures{"lkg-go", 4092, 4092, 11, 6, 372, 682, 1440, 2560},
                             Figures{"lkg-16-portrait", 5995, 6000, 11, 6, 545, 1000, 2160, 3840},
                             Figures{"lkg-16-landscape", 7680, 4320, 8, 6, 960, 720, 3840, 2160},
                             Figures{"lkg-32-portrait", 8184, 8184, 11, 6, 744, 1364, 4320, 7680},
                             Figures{"lkg-32-landscape", 8190, 8190, 7, 7, 1170, 1170, 7680, 4320},
                             Figures{"lkg-65", 8192, 8192, 8, 9, 1024, 910, 7680, 4320},
                             Figures{"lkg-8.9", 4096, 4096, 5, 9, 819, 455, 2560, 1600},
                             Figures{"lkg-15.6", 4096, 4096, 5, 9, 819, 455, 3840, 2160},
                             Figures{"lkg-8k", 8192, 8192, 5, 9, 1638, 910, 7680, 4320}}) {
        const QuiltDisplay& display = quilt_displays().find(f.name);
        EXPECT_EQ(std::pair(display.width, display.height), std::pair(f.width, f.height)) << f.name;
        EXPECT_EQ(std::pair(display.columns, display.rows), std::pair(f.columns, f.rows)) << f.name;
        EXPECT_EQ(std::pair(display.tile_width(), display.tile_height()), std::pair(f.tile_width, f.tile_height));
        EXPECT_NEAR(display.aspect, f.screen_width / f.screen_height, 1e-5) << f.name;
        EXPECT_TRUE(display.source.starts_with("https://")) << f.name;
    }
    EXPECT_EQ(quilt_displays().rows().size(), 10u);
}

TEST(ScaledView, KeepsTheMeanAndAveragesTheCoveredPixels) {
    Array<float, 3> picture({6, 4, 1});
    std::iota(picture.data(), picture.data() + 24, 1.0f);
    const Array<float, 3> halved = scaled_view(picture, 3, 2), same = scaled_view(picture, 6, 4);
    for (std::size_t y = 0; y < 3; ++y)
        for (std::size_t x = 0; x < 2; ++x)
            EXPECT_FLOAT_EQ(halved(y, x, 0), (picture(2 * y, 2 * x, 0) + picture(2 * y + 1, 2 * x + 1, 0)) / 2);
    EXPECT_TRUE(std::ranges::equal(same.elements(), picture.elements()));
    for (const auto& [height, width] : {std::pair<std::size_t, std::size_t>{5, 3}, {7, 9}, {1, 1}}) {
        const Array<float, 3> scaled = scaled_view(picture, height, width);
        double sum = 0;
        for (const float value : scaled.elements()) sum += value;
        EXPECT_NEAR(sum / static_cast<double>(height * width), 12.5, 1e-5);
    }
}

TEST(ExportViews, OrthographicViewsComeBackAndAreNoCameras) {
    LightFieldGrid grid = grid_of_cameras(3);
    grid.view = Perspective{{0.1, 0.075, 0, 0}, Face::front};
    const EightBits before(grid);
    EXPECT_THROW(export_views(before.light_field, before.folder.path(), {.layout = "hci"}), Error);
    export_views(before.light_field, before.folder.path(), {.layout = "numbered"});
    ViewImportOptions back = before.size();
    back.columns = 4;
    back.rows = 3;
    back.field_of_view = 2 * std::atan(0.1);
    expect_same(before.light_field, import_views(before.folder.path(), back).light_field, 0);
}

TEST(ExportViews, ViewsInGroupsAreTheSameFiles) {
    const EightBits made;
    const std::filesystem::path folder = made.folder.path();
    std::filesystem::create_directory(folder / "a");
    std::filesystem::create_directory(folder / "b");
    export_views(made.light_field, folder / "a", {});
    export_views(made.light_field, folder / "b", {.memory = 12 * 9 * 3 * 4 * 2.5});
    for (const auto& file : std::filesystem::directory_iterator(folder / "a")) {
        std::ifstream one(file.path(), std::ios::binary), two(folder / "b" / file.path().filename(), std::ios::binary);
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
