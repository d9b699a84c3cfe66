// SPDX-License-Identifier: Apache-2.0
// Sets of views with the file names of each layout, and the resulting rays.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "hogel/error.h"
#include "hogel/exchange.h"
#include "hogel/exchange/sparse_views.h"
#include "hogel/exchange/test_views.h"
#include "hogel/image.h"
#include "hogel/photograph.h"
#include "hogel/work/parallel.h"

namespace hogel::exchange {
namespace {

// Radiances of a whole light field.
LightFieldTile all_of(const LightField& light_field) {
    const LightFieldGrid& grid = light_field.grid();
    LightFieldTile tile(grid, {0, 0, grid.hogels_s, grid.hogels_t}, false);
    light_field.front().read(tile);
    return tile;
}

ViewImportOptions options_of(const TestScene& scene) {
    ViewImportOptions options;
    options.size = static_cast<double>(scene.width) * scene.pixel;
    options.distance = scene.distance;
    options.spacing = scene.spacing;
    return options;
}

// Every sample is the light along its ray, by the equations of docs/notation.md: at zeta = -D, x = s + U zeta is the
// camera position.
void expect_rays_of(const TestScene& scene, const LightField& light_field) {
    const LightFieldGrid& grid = light_field.grid();
    ASSERT_EQ(grid.hogels_s, scene.width);
    ASSERT_EQ(grid.hogels_t, scene.height);
    ASSERT_EQ(grid.directions_u, scene.columns);
    ASSERT_EQ(grid.directions_v, scene.rows);
    const LightFieldTile tile = all_of(light_field);
    std::size_t wrong = 0;
    for (std::size_t j = 0; j < scene.height; j += 5)
        for (std::size_t i = 0; i < scene.width; i += 3) {
            const LightFieldGrid hogel = grid.of_hogel(static_cast<double>(i), static_cast<double>(j));
            const double s = grid.s(static_cast<double>(i)), t = grid.t(static_cast<double>(j));
            for (std::size_t l = 0; l < scene.rows; ++l)
                for (std::size_t k = 0; k < scene.columns; ++k) {
                    const double cx = s - hogel.u(static_cast<double>(k)) * scene.distance;
                    const double cy = t - hogel.v(static_cast<double>(l)) * scene.distance;
                    const double code = std::round(200 * scene.radiance(cx, cy, s, t));
                    const float got = 255 * srgb_encode(tile.radiance(0, j, i, l, k));
                    // Rounding may let a ray at the card's edge pass it, and a code be the next one.
                    wrong += std::abs(got - code) > 1.5;
                }
        }
    EXPECT_LE(wrong, 5u);
}

void write_hci(const TestScene& scene, const TestFolder& folder) {
    for (std::size_t r = 0; r < scene.rows; ++r)
        for (std::size_t c = 0; c < scene.columns; ++c)
            folder.write(fmt::format("input_Cam{:03}.png", r * scene.columns + c), scene.png(r, c));
}

// parameters.cfg of the same cameras, ten times as large.
void write_parameters(const TestScene& scene, const TestFolder& folder) {
    const double tangent = scene.pixel / scene.distance;
    folder.write(
        "parameters.cfg",
        fmt::format("[intrinsics]\nfocal_length_mm = 50\nimage_resolution_x_px = {}\nimage_resolution_y_px = {}\n"
                    "sensor_size_mm = {}\n[extrinsics]\nnum_cams_x = {}\nnum_cams_y = {}\nbaseline_mm = {}\n"
                    "focus_distance_m = {}\n",
                    scene.width, scene.height, 50 * tangent * static_cast<double>(scene.width), scene.columns,
                    scene.rows, 1e4 * scene.spacing, 10 * scene.distance));
}

TEST(ImportViews, HciNamesAreRowsFromTheTopLeft) {
    const TestScene scene;
    const TestFolder folder;
    write_hci(scene, folder);
    ViewImportOptions options = options_of(scene);
    options.columns = scene.columns;
    options.rows = scene.rows;
    const ImportedViews views = import_views(folder.path(), options);
    EXPECT_EQ(views.layout, "hci");
    EXPECT_TRUE(views.assumed.empty());
    expect_rays_of(scene, views.light_field);
}

TEST(ImportViews, HciParametersSayEverythingButTheSize) {
    const TestScene scene;
    const TestFolder folder;
    write_hci(scene, folder);
    write_parameters(scene, folder);
    ViewImportOptions options;
    options.size = static_cast<double>(scene.width) * scene.pixel;
    const ImportedViews views = import_views(folder.path(), options);
    EXPECT_NEAR(views.scale, 0.1, 1e-12);
    EXPECT_NEAR(views.distance, scene.distance, 1e-12);
    EXPECT_NEAR(views.spacing, scene.spacing, 1e-12);
    EXPECT_TRUE(views.assumed.empty());
    EXPECT_NE(views.summary.find("4x3 cameras 100 mm apart, focused at 3 m"), std::string::npos) << views.summary;
    expect_rays_of(scene, views.light_field);
}

TEST(ImportViews, StanfordPlacesDecideWhichCameraIsWhere) {
    const TestScene scene;
    const TestFolder folder;
    for (std::size_t r = 0; r < scene.rows; ++r)
        for (std::size_t c = 0; c < scene.columns; ++c)  // rows are counted from the bottom, y grows downwards
            folder.write(fmt::format("out_{:02}_{:02}_{:.6f}_{:.6f}_.png", scene.rows - 1 - r, c,
                                     -1e3 * scene.camera_y(r) - 700, 1e3 * scene.camera_x(c) - 3000),
                         scene.png(r, c));
    const ImportedViews views = import_views(folder.path(), options_of(scene));
    EXPECT_EQ(views.layout, "stanford");
    expect_rays_of(scene, views.light_field);
}

TEST(ImportViews, TheParallaxSaysWhichNumberIsTheColumn) {
    const TestScene scene{.columns = 4, .rows = 3, .width = 96, .height = 80};
    for (const bool column_first : {false, true})
        for (const bool from_the_bottom : {false, true}) {
            const TestFolder folder;
            for (std::size_t r = 0; r < scene.rows; ++r)
                for (std::size_t c = 0; c < scene.columns; ++c) {
                    const std::size_t row = from_the_bottom ? scene.rows - 1 - r : r;
                    folder.write(
                        column_first ? fmt::format("{:03}_{:03}.png", c, row) : fmt::format("{:03}_{:03}.png", row, c),
                        scene.png(r, c));
                }
            SCOPED_TRACE(fmt::format("column {}, rows from the {}", column_first ? "first" : "second",
                                     from_the_bottom ? "bottom" : "top"));
            const ImportedViews views = import_views(folder.path(), options_of(scene));
            EXPECT_EQ(views.layout, "rows-columns");
            expect_rays_of(scene, views.light_field);
            if (from_the_bottom) continue;
            ViewImportOptions said = options_of(scene);
            said.column_first = column_first;
            expect_rays_of(scene, import_views(folder.path(), said).light_field);
        }
}

TEST(ImportViews, TenBitPixmapsAreSrgbLikeEightBitPictures) {
    const TestScene scene;
    const TestFolder folder;
    for (std::size_t r = 0; r < scene.rows; ++r)
        for (std::size_t c = 0; c < scene.columns; ++c) {
            const Array<std::uint8_t, 3> eight = scene.view(r, c);
            Array<std::uint16_t, 3> ten(eight.shape());
            for (std::size_t i = 0; i < ten.size(); ++i)
                ten.data()[i] = static_cast<std::uint16_t>(std::lround(eight.data()[i] * 1023.0 / 255));
            folder.write(fmt::format("{:03}_{:03}.ppm", r, c), image::pnm_file(ten, 1023));
        }
    ViewImportOptions options = options_of(scene);
    options.column_first = false;
    const ImportedViews views = import_views(folder.path(), options);
    EXPECT_EQ(views.bits, 10u);
    expect_rays_of(scene, views.light_field);
}

TEST(ImportViews, QuiltsRunFromTheBottomLeft) {
    TestScene scene{.columns = 6, .rows = 1};
    const TestFolder folder;
    Array<std::uint8_t, 3> quilt({2 * scene.height, 3 * scene.width, 3});
    for (std::size_t c = 0; c < scene.columns; ++c) {
        const Array<std::uint8_t, 3> view = scene.view(0, c);
        for (std::size_t y = 0; y < scene.height; ++y)
            std::copy_n(&view(y, 0, 0), scene.width * 3,
                        &quilt((c < 3 ? scene.height : 0) + y, c % 3 * scene.width, 0));
    }
    const auto bytes = image::png_file(quilt.view(), {}, image::Curve::srgb);
    folder.write("a_qs3x2a1.33333.png", bytes);
    const ImportedViews views = import_views(folder.path() / "a_qs3x2a1.33333.png", options_of(scene));
    EXPECT_EQ(views.layout, "quilt");
    expect_rays_of(scene, views.light_field);
    // Tiles whose pixels are twice as wide as high become half as many rows.
    folder.write("b_qs3x2a2.66667.png", bytes);
    const LightFieldGrid wide =
        import_views(folder.path() / "b_qs3x2a2.66667.png", options_of(scene)).light_field.grid();
    EXPECT_EQ(wide.hogels_s, scene.width);
    EXPECT_EQ(wide.hogels_t, scene.height / 2);
}

// Points nearer than the zero-parallax plane move left for a viewpoint that moves right.
TEST(ImportViews, TheParallaxHasTheSignOfTheScene) {
    const TestScene scene{.columns = 5, .rows = 1, .width = 64, .height = 48, .near = -0.03, .far = 0};
    const TestFolder folder;
    for (std::size_t c = 0; c < scene.columns; ++c) folder.write(fmt::format("view_0_{}.png", c), scene.png(0, c));
    folder.write("view_1_0.png", scene.png(0, 0));  // two numbers that vary; the second row is taken away below
    std::filesystem::remove(folder.path() / "view_1_0.png");
    ViewImportOptions options = options_of(scene);
    options.layout = "numbered";
    options.columns = scene.columns;
    options.rows = 1;
    options.orthographic = false;
    const LightField light_field = import_views(folder.path(), options).light_field;
    // Photographs through pinholes at the outermost cameras are their views.
    for (const std::size_t c : {std::size_t{0}, std::size_t{4}}) {
        Camera camera;
        camera.eye = {scene.camera_x(c), 0, scene.distance};
        camera.pupil = 1e-9;
        camera.picture = {scene.width, scene.height, scene.pixel, scene.pixel, 0, 0};
        const Image photo = photograph(light_field, {&camera, 1}).front();
        const auto error = [&](std::size_t view) {
            const Array<std::uint8_t, 3> codes = scene.view(0, view);
            double sum = 0;
            for (std::size_t i = 0; i < codes.size(); ++i)
                sum += std::pow(srgb_encode(photo.pixels.data()[i]) - static_cast<double>(codes.data()[i]) / 255, 2);
            return sum / static_cast<double>(codes.size());
        };
        EXPECT_LT(error(c), std::pow(10, -3.5)) << "35 dB";
        EXPECT_GT(error(scene.columns - 1 - c), 10 * error(c));
    }
}

TEST(ImportViews, OrthographicNumbersCountDirections) {
    // Each view is uniform, so that only the order matters: 2 rows of 3 directions.
    const TestFolder folder;
    for (std::size_t i = 0; i < 6; ++i)
        folder.write(fmt::format("v{:02}.png", i + 1),
                     image::png_file(Array<std::uint8_t, 3>({4, 5, 1}, static_cast<std::uint8_t>(10 * i)).view(), {},
                                     image::Curve::srgb));
    ViewImportOptions options;
    options.columns = 3;
    options.rows = 2;
    const ImportedViews views = import_views(folder.path(), options);
    ASSERT_TRUE(views.light_field.grid().is_perspective());
    const LightFieldTile tile = all_of(views.light_field);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(255 * srgb_encode(tile.radiance(0, 2, 2, i / 3, i % 3)), 10 * i, 0.01);
}

TEST(ImportViews, ADisparityBringsAnotherPlaneToTheHologram) {
    // In whole pixels: a plane whose parallax from view to view is 2 pixels, 1/D' = 1/D + 2 a/b.
    TestScene scene{
        .columns = 3, .rows = 3, .width = 64, .height = 48, .distance = 0.3, .spacing = 0.01, .pixel = 0.5e-3};
    const double nearer = 1 / (1 / scene.distance + 2 * scene.pixel / scene.distance / scene.spacing);
    scene.near = scene.far = nearer - scene.distance;
    const TestFolder folder;
    write_hci(scene, folder);
    write_parameters(scene, folder);
    ViewImportOptions options;
    options.disparity = 2;
    options.size = (static_cast<double>(scene.width) - 4) * scene.pixel * nearer / scene.distance;
    const ImportedViews views = import_views(folder.path(), options);
    const LightFieldGrid& grid = views.light_field.grid();
    EXPECT_EQ(grid.hogels_s, scene.width - 4);
    EXPECT_EQ(grid.hogels_t, scene.height - 4);
    EXPECT_NEAR(views.distance, nearer, 1e-12);
    EXPECT_LT(views.parallax, 0.2);
    // Everything lies on the hologram: all directions of a hogel are alike.
    const LightFieldTile tile = all_of(views.light_field);
    double worst = 0;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t i = 0; i < 9; ++i)
                worst =
                    std::max(worst, std::abs(static_cast<double>(srgb_encode(tile.radiance(0, t, s, i / 3, i % 3))) -
                                             srgb_encode(tile.radiance(0, t, s, 1, 1))));
    EXPECT_LT(worst, 1.5 / 255);
}

TEST(ImportViews, BandsAreTheWholeSet) {
    const TestScene scene;
    const TestFolder folder;
    write_hci(scene, folder);
    write_parameters(scene, folder);
    ViewImportOptions options = options_of(scene);
    const LightFieldTile whole = all_of(import_views(folder.path(), options).light_field);
    options.memory = 5 * 12 * 64 * 3;  // five rows
    const LightField banded = import_views(folder.path(), options).light_field;
    EXPECT_TRUE(std::ranges::equal(all_of(banded).radiance.elements(), whole.radiance.elements()));
    LightFieldBuffer buffer(banded.grid());
    write_views(banded, buffer);
    EXPECT_TRUE(std::ranges::equal(buffer.radiance.elements(), whole.radiance.elements()));
}

TEST(ImportViews, ASpoolFileLetsEachPictureBeDecodedOnce) {
    const TestScene scene;
    for (const double disparity : {0.0, 0.3}) {  // codes, and samples between pixels
        const TestFolder folder;
        write_hci(scene, folder);
        write_parameters(scene, folder);
        std::filesystem::create_directory(folder.path() / "spool");
        ViewImportOptions options = options_of(scene);
        options.disparity = disparity;
        const LightFieldTile whole = all_of(import_views(folder.path(), options).light_field);
        options.memory = 7 * 12 * 64 * 3 * (disparity > 0 ? 4 : 1);
        options.spool = folder.path() / "spool";
        {
            const ImportedViews views = import_views(folder.path(), options);
            EXPECT_EQ(views.spool_bytes, views.light_field.samples() * (disparity > 0 ? 4 : 1));
            const LightFieldGrid& grid = views.light_field.grid();
            LightFieldTile first(grid, {0, 0, 1, 1}, false);
            views.light_field.front().read(first);
            for (std::size_t i = 0; i < 12; ++i)
                std::filesystem::remove(folder.path() / fmt::format("input_Cam{:03}.png", i));
            EXPECT_TRUE(std::ranges::equal(all_of(views.light_field).radiance.elements(), whole.radiance.elements()));
            EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "spool"));  // it has no name
        }
    }
}

TEST(ImportViews, SparseViewsAreToldToEveryMethod) {
    LightFieldGrid grid{96, 80, 0.5e-3, 3, 3, FocalPlane{{0.05, 0.05, 0, 0}, -0.3}, 3};
    const std::vector<std::string> few = sparse_views(grid, 3.3);
    ASSERT_EQ(few.size(), 2u);
    EXPECT_NE(
        few[0].find("up to 3.3 hogels from a view to the next; 8x8 views over the same angle would suffice, 4 times"),
        std::string::npos)
        << few[0];
    // 2 x 0.05 over 532 nm / 0.5 mm.
    EXPECT_NE(few[1].find("olas, with hogels of one sample: these do; phase-added: refuses fewer than 94x94"),
              std::string::npos)
        << few[1];
    // A row of many: 8 samples, where olas takes 4, and lobes that are wide enough.
    grid.directions_u = 101;
    grid.directions_v = 1;
    const std::vector<std::string> row = sparse_views(grid, 8);
    EXPECT_NE(row[1].find("hogels below 801x1; olas, with hogels of one sample: side lobes below 201x1; phase-added: "
                          "these do"),
              std::string::npos)
        << row[1];
}

TEST(ImportViews, StopsWhenAsked) {
    const TestScene scene;
    const TestFolder folder;
    write_hci(scene, folder);
    write_parameters(scene, folder);
    ViewImportOptions options;
    options.memory = 1;  // a row of hogels at a time
    const LightField light_field = import_views(folder.path(), options).light_field;
    LightFieldBuffer buffer(light_field.grid());
    EXPECT_THROW(write_views(light_field, buffer, Progress([](double done) { return done < 0.3; })), Error);
}

}  // namespace
}  // namespace hogel::exchange
