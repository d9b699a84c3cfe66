// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "hogel/error.h"
#include "hogel/requests.h"
#include "hogel/words/test_texts.h"

namespace hogel {
namespace {

ImportedViews imported_views() {
    LightFieldGrid grid;
    grid.hogels_s = grid.hogels_t = grid.directions_u = grid.directions_v = 3;
    grid.pitch = 1e-3 / 7;
    grid.view = field_of_view(0.2, 0.2);
    return {.light_field = light_field_from(grid, [](double, double, double, double) { return 1.0; }),
            .layout = "rows-columns",
            .transfer = Transfer::linear,
            .summary = {},
            .assumed = {},
            .notes = {}};
}

TEST(ImportParameters, that_acted_ask_for_the_same_again) {
    const std::vector<Metadata> cases{
        {},
        {{"size", "4mm"}, {"distance", "0.2m"}, {"fov", "10deg"}},
        {{"views", "3x4"}, {"middle", "2"}, {"column", "first"}, {"mirror", "both"}},
        {{"projection", "orthographic"}, {"transfer", "srgb"}, {"densify", "3"}, {"depth-scale", "1000"}},
        {{"disparity", "-1.5"}, {"spacing", "3mm"}, {"estimate-disparity", "yes"}}};
    for (const Metadata& texts : cases) {
        FromTexts<ImportParameters> first(texts);
        first.values.resolve(imported_views());
        const FromTexts<ImportParameters> again(first.table.acting());
        const ViewImportOptions a = first.values.options(), b = again.values.options();
        EXPECT_EQ(a.layout, "rows-columns");
        EXPECT_EQ(a.size, imported_views().light_field.grid().width());
        EXPECT_EQ(a.transfer, Transfer::linear);
        EXPECT_EQ(a.layout, b.layout);
        EXPECT_EQ(a.size, b.size);
        EXPECT_EQ(a.distance, b.distance);
        EXPECT_EQ(a.spacing, b.spacing);
        EXPECT_EQ(a.field_of_view, b.field_of_view);
        EXPECT_EQ(a.transfer, b.transfer);
        EXPECT_EQ(a.orthographic, b.orthographic);
        EXPECT_EQ(a.column_first, b.column_first);
        EXPECT_EQ(std::pair(a.columns, a.rows), std::pair(b.columns, b.rows));
        EXPECT_EQ(std::pair(a.middle_columns, a.middle_rows), std::pair(b.middle_columns, b.middle_rows));
        EXPECT_EQ(std::pair(a.mirror_columns, a.mirror_rows), std::pair(b.mirror_columns, b.mirror_rows));
        EXPECT_EQ(a.disparity, b.disparity);
        EXPECT_EQ(a.densify, b.densify);
        EXPECT_EQ(a.depth_scale, b.depth_scale);
        EXPECT_EQ(a.estimate_disparity, b.estimate_disparity);
    }
}

TEST(ExportParameters, that_acted_ask_for_the_same_again) {
    const std::vector<Metadata> cases{
        {}, {{"layout", "hci"}}, {{"bits", "10"}, {"pictures", "ppm"}}, {{"transfer", "linear"}, {"exposure", "0.3"}}};
    for (const char* output : {"views", "views.npy", "views.mat", "all_qs3x3a1.exr", "walk.mp4", "walk##.gif"})
        for (const Metadata& texts : cases) {
            FromTexts<ExportParameters> first(texts);
            first.values.resolve(output);
            FromTexts<ExportParameters> again(first.table.acting());
            again.values.resolve(output);
            const ViewExportOptions a = first.values.options(), b = again.values.options();
            EXPECT_EQ(a.layout, b.layout) << output;
            EXPECT_EQ(a.format, b.format) << output;
            EXPECT_EQ(a.bits, b.bits) << output;
            EXPECT_EQ(a.transfer, b.transfer) << output;
            EXPECT_EQ(a.exposure, b.exposure) << output;
        }
}

TEST(ExportParameters, take_the_layout_of_the_name_unless_one_is_given) {
    const auto layout = [](const char* output, const Metadata& texts) {
        FromTexts<ExportParameters> asked(texts);
        asked.values.resolve(output);
        return asked.values.options().layout;
    };
    EXPECT_EQ(layout("views", {}), "rows-columns");
    EXPECT_EQ(layout("views.npy", {}), "npy");
    EXPECT_EQ(layout("views.mat", {}), "mat");
    EXPECT_EQ(layout("all_qs3x3a1.png", {}), "quilt");
    EXPECT_EQ(layout("views_qs", {}), "rows-columns");
    EXPECT_EQ(layout("views.npy", {{"layout", "hci"}}), "hci");
    EXPECT_THROW(layout("views", {{"layout", "nosuch"}}), Error);
}

TEST(ExportParameters, of_a_film_are_those_of_its_pictures) {
    FromTexts<ExportParameters> asked({{"layout", "hci"}, {"bits", "16"}, {"frame-rate", "5"}});
    asked.values.resolve("walk.gif");
    const ViewExportOptions pictures = asked.values.options();
    EXPECT_EQ(pictures.layout, "rows-columns");
    EXPECT_EQ(pictures.bits, 8U);
    EXPECT_EQ(asked.table.acting(), (Metadata{{"exposure", "auto"}, {"frame-rate", "5"}}));
}

TEST(ExportParameters, expose_quilts_and_films_automatically_unless_told) {
    const auto exposure = [](const char* output, const Metadata& texts) {
        FromTexts<ExportParameters> asked(texts);
        asked.values.resolve(output);
        return asked.values.options().exposure;
    };
    EXPECT_EQ(exposure("views", {}), 1);
    EXPECT_EQ(exposure("a_qs2x2a1.png", {}), 0);
    EXPECT_EQ(exposure("a.gif", {}), 0);
    EXPECT_EQ(exposure("views", {{"exposure", "auto"}}), 0);
    EXPECT_EQ(exposure("a_qs2x2a1.png", {{"exposure", "0.5"}}), 0.5);
    for (const char* wrong : {"0", "-1", "nan", "bright"})
        EXPECT_THROW(exposure("views", {{"exposure", wrong}}), Error);
}

// The light field of a scene for a quilt, or the error.
struct QuiltOfScene {
    FromTexts<ExportParameters> views;
    LightFieldParameters scene;
    Parameters table;

    QuiltOfScene(const std::string& output, const Metadata& of_views, const Metadata& of_scene) : views(of_views) {
        scene.declare(table);
        scene.declare_focal_plane(table);
        for (const auto& [name, text] : of_scene) table.look_up(name)->read_value(text, name);
        views.values.resolve(output);
        views.values.set_cameras(scene, output, table);
    }
    std::string note(double low, double high) const {
        Scene placed;
        Mesh mesh;
        mesh.positions = {{-1e-3, 0, low}, {1e-3, 0, high}, {0, 1e-3, low}};
        mesh.triangles = {{0, 1, 2}};
        placed.meshes.push_back(mesh);
        return views.values.note_about_depth(placed, scene);
    }
};

TEST(ExportParameters, of_a_quilt_make_its_cameras) {
    const QuiltOfScene portrait("x_qs8x6a0.75.png", {}, {});
    EXPECT_EQ(portrait.views.values.device, "lkg-portrait");
    const LightFieldGrid grid = portrait.scene.grid();
    EXPECT_EQ(std::pair(grid.hogels_s, grid.hogels_t), std::pair(std::size_t{420}, std::size_t{560}));
    EXPECT_EQ(std::pair(grid.directions_u, grid.directions_v), std::pair(std::size_t{48}, std::size_t{1}));
    ASSERT_NE(grid.focal_plane(), nullptr);
    EXPECT_NEAR(grid.half_u(), std::tan(0.5 * 40 * 3.14159265358979 / 180), 1e-12);
    EXPECT_NEAR(grid.step_v(), grid.step_u(), 1e-12);
    EXPECT_NEAR(0.5 * grid.height() / -grid.focal_plane()->depth, std::tan(7 * 3.14159265358979 / 180), 1e-12);
    // Square hogels are at least as fine as the pixels of tiles, which are not square.
    const QuiltOfScene landscape("x_qs8x6a1.778.png", {{"device", "lkg-16-landscape"}}, {{"fov", "30deg"}});
    EXPECT_EQ(landscape.scene.hogels, (Counts{1280, 720}));
    EXPECT_NEAR(landscape.scene.field_of_view.across, 30 * 3.14159265358979 / 180, 1e-12);
    const QuiltOfScene other("x_qs5x4a0.5.png", {}, {{"hogels", "30x60"}, {"focal-plane", "-50mm"}});
    EXPECT_EQ(other.views.values.device, "");
    EXPECT_EQ(other.scene.hogels, (Counts{30, 60}));
    EXPECT_EQ(other.scene.directions, (Counts{20, 1}));
    EXPECT_EQ(other.scene.focal_plane, -0.05);
}

TEST(ExportParameters, of_a_quilt_refuse_other_views) {
    EXPECT_THROW(QuiltOfScene("x_qs8x6a0.75.png", {}, {{"directions", "48x2"}}), Error);
    EXPECT_THROW(QuiltOfScene("x_qs8x6a0.75.png", {}, {{"hogels", "400x400"}}), Error);
    EXPECT_NO_THROW(QuiltOfScene("x_qs8x6a0.75.png", {}, {{"hogels", "420x560"}, {"directions", "48x1"}}));
    EXPECT_THROW(QuiltOfScene("x_qs.png", {{"layout", "quilt"}}, {}), Error);
    EXPECT_THROW(QuiltOfScene("views", {{"device", "lkg-portait"}}, {}), Error);
    EXPECT_THROW(QuiltOfScene("views", {{"device", "lkg-go"}, {"layout", "hci"}}, {}), Error);
}

// At the depths of the note, D = 108.59 mm, points move by 5 pixels of 20/420 mm between cameras 1.647 mm apart.
TEST(ExportParameters, tell_the_depths_at_which_a_quilt_is_sharp) {
    const QuiltOfScene portrait("x_qs8x6a0.75.png", {}, {});
    const std::string depths =
        "depths from -13.7 mm to 18.4 mm stay below 5 pixels of disparity between neighbouring views; ";
    EXPECT_EQ(portrait.note(-18e-3, 13e-3), depths + "the scene spans -13 mm to 18 mm");
    EXPECT_EQ(portrait.note(-18e-3, 30e-3), depths + "the scene spans -30 mm to 18 mm: --fov 15.7deg keeps it sharp");
    QuiltOfScene file("x_qs8x6a0.75.png", {}, {});
    file.scene.scene.is_file = true;
    EXPECT_EQ(file.note(-30e-3, 0), depths + "the scene spans 0 mm to 30 mm: --front 0.43 keeps it sharp");
    EXPECT_EQ(file.note(-50e-3, 0), depths + "the scene spans 0 mm to 50 mm: --front 0.39 --fov 27deg keeps it sharp");
}

TEST(HologramParameters, of_a_scene_make_a_grid_of_its_size_for_each_wavelength) {
    FromTexts<HologramParameters> asked({{"wavelength", "650,500nm"}, {"pitch", "10um"}});
    asked.values.method = "points";
    asked.values.spacing = 3e-6;
    LightFieldParameters place;
    place.size = 4e-3;
    place.hogels = {40, 10};
    const SceneHologramRequest request = asked.values.scene_request(7, place);
    ASSERT_EQ(request.grids.size(), 2U);
    EXPECT_EQ(request.grids[0], (FieldGrid{{400, 100, 10e-6, 10e-6, 0, 0}, 650e-9}));
    EXPECT_EQ(request.grids[1].wavelength, 500e-9);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(request.options[i].channel, channel_of(request.grids[i].wavelength));
        EXPECT_EQ(request.options[i].seed, 7U);
        EXPECT_EQ(request.options[i].spacing, 3e-6);
    }
}

TEST(HologramParameters, of_a_scene_refuse_what_its_methods_cannot) {
    const auto parameter_refused = [](const std::string& method, double size, bool fronts_only) -> std::string {
        HologramParameters asked;
        asked.method = method;
        asked.wavelengths = {633e-9};
        LightFieldParameters place;
        place.size = size;
        place.fronts_only = fronts_only;
        try {
            static_cast<void>(asked.scene_request(1, place));
        } catch (const Error& error) {
            return error.parameter();
        }
        return "none";
    };
    EXPECT_EQ(parameter_refused("planes", 1e-3, false), "none");
    EXPECT_EQ(parameter_refused("fourier", 1e-3, false), "method");
    EXPECT_EQ(parameter_refused("planes", 1e-6, false), "size, pitch");
    EXPECT_EQ(parameter_refused("planes", 1e-3, true), "cull_back_faces");
}

TEST(CamerasParameters, make_a_grid_whose_focal_plane_is_that_of_the_cameras) {
    const FromTexts<CamerasParameters> asked(
        {{"size", "2m"}, {"hogels", "80x60"}, {"directions", "5x1"}, {"distance", "10m"}});
    const LightFieldGrid grid = asked.values.grid();
    EXPECT_DOUBLE_EQ(grid.width(), 2);
    EXPECT_DOUBLE_EQ(grid.height(), 1.5);
    EXPECT_EQ(std::pair(grid.directions_u, grid.directions_v), (std::pair<std::size_t, std::size_t>(5, 1)));
    ASSERT_NE(grid.focal_plane(), nullptr);
    EXPECT_EQ(grid.focal_plane()->depth, -10);
}

}  // namespace
}  // namespace hogel
