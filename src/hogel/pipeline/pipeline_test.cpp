// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/error.h"
#include "hogel/resume.h"
#include "hogel/units.h"

namespace hogel::pipeline {
namespace {

using namespace hogel::literals;

class Pipeline : public ::testing::Test {
  protected:
    Pipeline() {
        std::string name = std::filesystem::temp_directory_path() / "hogel_pipeline_XXXXXX";
        folder_ = mkdtemp(name.data());
        request_.grid = {8, 8, 0.25_mm, 32, 32, field_of_view(16_deg)};
        holograms_.channels = rgb(633_nm, 532_nm, 460_nm);
        holograms_.pitch = 1.5625_um;
    }
    ~Pipeline() override { std::filesystem::remove_all(folder_); }

    LightField rendered() const { return render_light_field(load_scene("sphere", request_), request_); }

    std::filesystem::path folder_;
    LightFieldRequest request_;
    HologramRequest holograms_;
};

std::string entry(const Provenance& provenance, const std::string& key) {
    for (const auto& [name, text] : provenance.entries)
        if (name == key) return text;
    return "(none)";
}

// From a scene to a picture file, with a file after each step.
TEST_F(Pipeline, provenance_travels_through_all_files) {
    const LightField light_field = rendered();
    EXPECT_EQ(entry(light_field.provenance(), "scene"), "sphere");
    EXPECT_EQ(entry(light_field.provenance(), "renderer"), "epi");

    const auto radiance = folder_ / "a.h5", stream = folder_ / "a.hgl", fields = folder_ / "b.h5";
    write_light_field(radiance, light_field, {.metadata = {{"command", "first"}}});
    CompressionOptions compression;
    compression.metadata = {{"command", "second"}};
    compress(open_light_field(radiance), stream, compression);
    const LightField decoded = open_light_field(stream);
    write_holograms(fields, make_holograms(decoded, holograms_), {.metadata = {{"command", "third"}}});
    const Fields opened = open_hologram(fields);
    const Camera camera = camera_for(2_mm, 2_mm, 20);
    const Image picture = photograph_colours(opened, {&camera, 1}).front();
    for (const char* name : {"c.png", "c.exr"}) {
        write_image(folder_ / name, picture, 1, {{"command", "fourth"}});
        const Provenance provenance = read_image(folder_ / name).provenance;
        EXPECT_EQ(provenance.camera, camera) << name;
        EXPECT_EQ(entry(provenance, "command"), "fourth") << name;
        EXPECT_EQ(entry(provenance, "source command"), "third") << name;
        EXPECT_EQ(entry(provenance, "source source command"), "second") << name;
        EXPECT_EQ(entry(provenance, "source source source command"), "first") << name;
        EXPECT_EQ(entry(provenance, "scene"), "sphere") << name;
    }
}

/// A square sheet, in strips of its height that are divided into columns of squares.
Scene sheet(std::size_t columns, std::size_t rows) {
    Scene scene;
    Mesh& mesh = scene.meshes.emplace_back();
    const auto vertex = [&](std::size_t i, std::size_t j) { return static_cast<std::uint32_t>(i * (rows + 1) + j); };
    for (std::size_t i = 0; i <= columns; ++i)
        for (std::size_t j = 0; j <= rows; ++j) {
            const double x = static_cast<double>(i) / static_cast<double>(columns);
            mesh.positions.push_back({x, static_cast<double>(j) / static_cast<double>(rows), 0.1 * x});
            mesh.normals.push_back({0, 0, 1});
        }
    for (std::size_t i = 0; i < columns; ++i)
        for (std::size_t j = 0; j < rows; ++j) {
            mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
            mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
    return scene;
}

TEST_F(Pipeline, large_triangles_of_a_file_are_lit_at_each_point) {
    const auto model = [&](const Scene& scene, const std::string& asked) {
        LightFieldRequest request = request_;
        request.shading.model = asked;
        return entry({light_scene(scene, request)->provenance, {}}, "shading");
    };
    const Scene strips = prepare_scene(sheet(60, 1), request_), squares = prepare_scene(sheet(20, 20), request_),
                few = prepare_scene(sheet(6, 1), request_);
    EXPECT_EQ(request_.shading.model, defaults.shading);
    EXPECT_EQ(model(strips, "auto"), "direct");
    EXPECT_EQ(model(strips, "vertex"), "vertex");
    EXPECT_EQ(model(squares, "auto"), "vertex");
    EXPECT_EQ(model(squares, "direct"), "direct");
    EXPECT_EQ(model(few, "auto"), "vertex");
    EXPECT_EQ(model(load_scene("pumpkin", request_), "auto"), "vertex");
    // Shadow maps larger than allowed are used only on request.
    EXPECT_EQ(shading_model(strips, {.model = "auto", .max_shadow_bytes = 1000}), "vertex");
    EXPECT_EQ(shading_model(strips, {.model = "direct", .max_shadow_bytes = 1000}), "direct");
    EXPECT_GT(shadow_map_bytes(strips, {.model = "auto"}), 0);
    EXPECT_EQ(shadow_map_bytes(squares, {.model = "auto"}), 0);
}

// Most of a long street would be behind the viewer.
TEST_F(Pipeline, what_is_before_the_hologram_stays_within_reach) {
    Scene street;
    Mesh& mesh = street.meshes.emplace_back();
    const auto front = [&](double depth, double asked) {
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, -depth}, {0, 1, -depth}};
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
        mesh.normals.assign(4, {0, 0, 1});
        request_.front = asked;
        const Scene placed = prepare_scene(street, request_);
        return std::pair{bounds(placed).high.z, placed.notes.size()};
    };
    const double width = 2e-3, fill = Fit{}.fill;
    EXPECT_NEAR(front(1, 0.3).first, 0.3 * fill * width, 1e-9);
    EXPECT_EQ(front(1, 0.3).second, 0u);
    EXPECT_NEAR(front(1, 1).first, fill * width, 1e-9);
    EXPECT_NEAR(front(50, 0.3).first, width, 1e-9);
    EXPECT_EQ(front(50, 0.3).second, 1u);
    EXPECT_NEAR(front(0, 0.3).first, 0, 1e-9);
}

// A note reports gloss that the model does not show.
TEST_F(Pipeline, gloss_that_is_not_shown_is_noted) {
    Scene scene;
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.normals.assign(4, {0, 0, 1});
    const auto notes = [&](float metallic, float roughness, const char* model) {
        mesh.material.reflectance = 0.04f;
        mesh.material.metallic = metallic, mesh.material.roughness = roughness;
        request_.shading.model = model;
        return prepare_scene(scene, request_).notes.size();
    };
    EXPECT_EQ(notes(0, 0.8f, "auto"), 0u);
    EXPECT_EQ(notes(0, 0.2f, "auto"), 1u);
    EXPECT_EQ(notes(1, 0.5f, "vertex"), 1u);
    EXPECT_EQ(notes(1, 0.5f, "direct"), 0u);
}

TEST_F(Pipeline, a_light_field_keeps_its_camera) {
    const Camera camera = camera_for(2_mm, 2_mm, 40);
    const auto radiance = folder_ / "a.h5", stream = folder_ / "a.hgl";
    const LightField light_field = rendered().with({{{"scene", "mine"}}, camera});
    write_light_field(radiance, light_field, {});
    EXPECT_EQ(open_light_field(radiance).provenance().camera, camera);
    compress(open_light_field(radiance), stream, {});
    EXPECT_EQ(open_light_field(stream).provenance().camera, camera);
    EXPECT_EQ(prepare_for_reading(light_field, 3, false).provenance().camera, camera);
    EXPECT_EQ(make_holograms(light_field, holograms_).front()->provenance().camera, camera);
    // The metadata of a picture have its own camera, and keep the entry of the earlier one.
    const Camera other = camera_for(2_mm, 2_mm, 10);
    const Image picture = photograph(light_field, {&other, 1}).front();
    EXPECT_EQ(picture.provenance.camera, other);
    EXPECT_EQ(entry(picture.provenance, "camera"), describe(camera));
}

TEST_F(Pipeline, photographs_go_into_the_callers_pictures) {
    const LightField light_field = rendered();
    const std::vector<Camera> cameras{camera_for(2_mm, 2_mm, 20), camera_for(2_mm, 2_mm, 30)};
    const auto hologram = make_holograms(light_field, holograms_).front();
    std::vector<Image> pictures(2);
    pictures[0] = Image(20, 20, 3);
    std::ranges::fill(pictures[0].pixels.elements(), 7.0f);
    photograph_into(light_field, cameras, {}, pictures);
    const float* const memory = pictures[0].pixels.data();
    const std::vector<Image> alone = photograph(light_field, cameras);
    for (int i = 0; i < 2; ++i)
        EXPECT_TRUE(std::ranges::equal(pictures[i].pixels.elements(), alone[i].pixels.elements())) << i;
    photograph_into(light_field, cameras, {}, pictures);
    EXPECT_EQ(pictures[0].pixels.data(), memory);
    photograph_into(*hologram, cameras, {}, pictures);
    const std::vector<Image> waves = photograph(*hologram, cameras);
    for (int i = 0; i < 2; ++i)
        EXPECT_TRUE(std::ranges::equal(pictures[i].pixels.elements(), waves[i].pixels.elements())) << i;
    EXPECT_THROW(photograph_into(light_field, cameras, {}, {pictures.data(), 1}), Error);
    EXPECT_THROW(photograph_into(*hologram, cameras, {}, {pictures.data(), 1}), Error);
}

TEST_F(Pipeline, one_camera_takes_one_picture) {
    const LightField light_field = rendered();
    const Fields holograms = make_holograms(light_field, holograms_);
    const Camera camera = camera_for(2_mm, 2_mm, 20);
    const auto same = [](const Image& one, const std::vector<Image>& list) {
        return list.size() == 1 && one.provenance == list[0].provenance &&
               std::ranges::equal(one.pixels.elements(), list[0].pixels.elements());
    };
    EXPECT_TRUE(same(photograph(light_field, camera, {8}), photograph(light_field, {&camera, 1}, {8})));
    EXPECT_TRUE(same(photograph(*holograms[0], camera), photograph(*holograms[0], {&camera, 1})));
    EXPECT_TRUE(same(photograph_colours(holograms, camera), photograph_colours(holograms, {&camera, 1})));
}

double psnr(const Image& a, const Image& b) {
    double error = 0, peak = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        error += std::pow(double(a.pixels.data()[i]) - double(b.pixels.data()[i]), 2);
        peak = std::max(peak, double(b.pixels.data()[i]));
    }
    return 10 * std::log10(peak * peak * double(a.pixels.size()) / error);
}

// All hogels of a hologram have the same directions. The hologram of a light field with a fixed focal plane looks like
// that of a light field rendered with common directions, and each looks like the rays of the other.
TEST_F(Pipeline, a_light_field_with_a_fixed_focal_plane_becomes_a_hologram) {
    request_.grid = {32, 32, 0.25_mm, 48, 48, field_of_view(16_deg)};
    const LightFieldGrid parallel = request_.grid;
    request_.grid.view = FocalPlane{parallel.range(), -100_mm};
    // Far behind the hologram, so that neighbouring directions see different points.
    Scene scene = load_scene("sphere", request_);
    for (Mesh& mesh : scene.meshes)
        for (Vec3& p : mesh.positions) p.z -= 20_mm;
    const LightField through_plane = render_light_field(scene, request_);
    LightFieldFileOptions file;
    file.type = SampleType::single;
    write_light_field(folder_ / "a.h5", through_plane, file);
    holograms_.pitch = 1.25_um;  // the range of common directions is larger than that of one hogel
    const LightField opened = open_for_holograms(folder_ / "a.h5", holograms_, false);
    EXPECT_EQ(opened.grid(), common_directions(through_plane.grid()));
    EXPECT_NE(entry(opened.provenance(), "directions").find("-100 mm"), std::string::npos);
    request_.grid = opened.grid();
    const LightField direct = render_light_field(scene, request_);
    std::vector<Camera> cameras(2, camera_for(8_mm, 8_mm, 48));
    cameras[1].eye = {-8_mm, 4_mm, 250_mm};
    const SpeckleFreeCamera expected;
    const std::vector<Image> waves = photograph_colours(make_holograms(opened, holograms_), cameras, expected);
    const std::vector<Image> direct_waves = photograph_colours(make_holograms(direct, holograms_), cameras, expected);
    const std::vector<Image> rays = photograph(through_plane, cameras, {256});
    const std::vector<Image> direct_rays = photograph(direct, cameras, {256});
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        RecordProperty("waves_db_" + std::to_string(i), std::to_string(psnr(waves[i], direct_waves[i])));
        RecordProperty("rays_db_" + std::to_string(i), std::to_string(psnr(rays[i], direct_rays[i])));
        RecordProperty("waves_of_rays_db_" + std::to_string(i), std::to_string(psnr(waves[i], rays[i])));
        RecordProperty("direct_db_" + std::to_string(i), std::to_string(psnr(direct_waves[i], direct_rays[i])));
        EXPECT_GT(psnr(waves[i], direct_waves[i]), 45) << i;
        EXPECT_GT(psnr(rays[i], direct_rays[i]), 45) << i;
        EXPECT_GT(psnr(waves[i], rays[i]), psnr(direct_waves[i], direct_rays[i]) - 1) << i;
    }
}

TEST_F(Pipeline, a_printer_is_given_directions_in_common) {
    const LightFieldGrid grid{2, 2, 1_mm, 8, 6, FocalPlane{{0.4, 0.3}, 5_mm}, 1};
    write_printer_images(folder_, borrow(LightFieldBuffer(grid)), {});
    const Image hogel = read_image(folder_ / "hogel_1.png");
    EXPECT_EQ(hogel.width(), common_directions(grid).directions_u);
    EXPECT_EQ(hogel.height(), common_directions(grid).directions_v);
    EXPECT_GT(hogel.width(), 8u);
}

// Light that differs in every ray, below white.
double light_of(std::size_t c, std::size_t t, std::size_t s, std::size_t v, std::size_t u) {
    return static_cast<double>((c * 7 + t * 11 + s * 13 + v * 17 + u * 19) % 97) / 100;
}

LightFieldBuffer distinct_rays(const LightFieldGrid& grid) {
    LightFieldBuffer rays(grid);
    for (std::size_t c = 0; c < grid.channels; ++c)
        for (std::size_t t = 0; t < grid.hogels_t; ++t)
            for (std::size_t s = 0; s < grid.hogels_s; ++s)
                for (std::size_t v = 0; v < grid.directions_v; ++v)
                    for (std::size_t u = 0; u < grid.directions_u; ++u)
                        rays.radiance(c, t, s, v, u) = static_cast<float>(light_of(c, t, s, v, u));
    return rays;
}

TEST_F(Pipeline, pictures_for_printers_are_the_rays_by_every_option) {
    const LightFieldGrid grid{3, 2, 1_mm, 5, 4, Perspective{0.1, 0.1}, 3};
    const LightFieldBuffer rays = distinct_rays(grid);
    for (int bits = 0; bits < 32; ++bits) {
        const bool columns = bits & 1, rows = bits & 2, transpose = bits & 4, planes = bits & 8, table = bits & 16;
        PrinterImageOptions options{
            .planes = planes, .mirror_columns = columns, .mirror_rows = rows, .transpose = transpose};
        options.dose = {1, 0.5, 2};
        options.bits = table ? 16 : 8;
        options.transfer = Transfer::linear;
        if (table) options.table = {1, 0.5, 0};
        options.circle = true;
        PrinterImages made = write_printer_images(folder_, borrow(rays), options);
        EXPECT_EQ(made.pictures, 6u);
        EXPECT_EQ(made.samples, 6u * 60);
        std::uint64_t clipped = 0;
        for (std::size_t number = 0; number < 6; ++number) {
            const std::size_t t = number / 3, s = t == 0 ? number : 5 - number;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::string plane = planes ? std::string("_") + "rgb"[c] : "";
                const RawChannels picture =
                    read_raw_channels(folder_ / ("hogel_" + std::to_string(number + 1) + plane + ".png"));
                for (std::size_t v = 0; v < 4; ++v)
                    for (std::size_t u = 0; u < 5; ++u) {
                        const bool is_corner = (u == 0 || u == 4) && (v == 0 || v == 3);
                        const double light = is_corner ? 0 : light_of(c, t, s, v, u) * options.dose[c];
                        clipped += light > 1 ? 1 : 0;
                        std::size_t x = columns ? 4 - u : u, y = rows ? 3 - v : v;
                        if (transpose) std::swap(x, y);
                        const double shown = std::min(light, 1.0);
                        ASSERT_NEAR(picture.values(y, x, planes ? 0 : c) / static_cast<double>(picture.largest),
                                    table ? 1 - shown : shown, table ? 1e-5 : 2e-3);
                    }
            }
        }
        EXPECT_EQ(made.clipped, clipped);
        EXPECT_GT(clipped, 0u);
    }
}

// Counts the rows that are read, and fails at the given one.
class FailingRays final : public LightFieldSource {
  public:
    FailingRays(const LightFieldBuffer& rays, std::size_t fails_at) : rays_(rays), fails_at_(fails_at) {}
    const LightFieldGrid& grid() const override { return rays_.grid(); }
    void read(LightFieldTile& tile) const override {
        if (tile.range.t0 == fails_at_) throw Error(ErrorCode::bad_input, "unreadable");
        ++rows;
        rays_.read(tile);
    }
    mutable std::size_t rows = 0;

  private:
    const LightFieldBuffer& rays_;
    std::size_t fails_at_;
};

TEST_F(Pipeline, more_than_4096_pictures_are_in_folders_and_continue_with_the_first_that_is_missing) {
    const LightFieldGrid grid{70, 59, 1_mm, 1, 1, Perspective{0.1, 0.1}, 1};
    const LightFieldBuffer rays = distinct_rays(grid);
    const FailingRays failing(rays, 40), whole(rays, 1000);
    const auto print = [&](const LightFieldSource& source) {
        ResumeScope scope(folder_ / "print.part", {"print"});
        PrinterImages made = write_printer_images(folder_ / "plate", borrow(source), {});
        scope.complete();
        return made;
    };
    EXPECT_THROW(print(failing), Error);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "plate/part_40/hogel_2800.png"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "plate/manifest.json"));
    const PrinterImages made = print(whole);
    EXPECT_EQ(whole.rows, 19u);
    EXPECT_EQ(made.samples, 70u * 59);
    EXPECT_EQ(made.last, folder_ / "plate/part_59/hogel_4130.png");
    std::uint64_t bytes = 0;
    for (std::size_t number = 1; number <= 4130; ++number) {
        const std::string part = std::to_string((number - 1) / 70 + 1), name = std::to_string(number);
        bytes += std::filesystem::file_size(folder_ / "plate" / ("part_" + std::string(2 - part.size(), '0') + part) /
                                            ("hogel_" + std::string(4 - name.size(), '0') + name + ".png"));
    }
    EXPECT_EQ(made.bytes, bytes);
}

TEST_F(Pipeline, radiance_that_is_not_finite_is_refused_by_place) {
    constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const auto& [value, type] : {std::pair{infinity, SampleType::single},
                                      {nan, SampleType::single},
                                      {infinity, SampleType::half},
                                      {nan, SampleType::half}}) {
        LightFieldBuffer rays({5, 4, 64_um, 8, 6, Perspective{0.1, 0.1}, 3});
        rays.radiance(1, 3, 2, 4, 5) = value;
        LightFieldFileOptions file;
        file.type = type;
        write_light_field(folder_ / "a.h5", borrow(rays), file);
        HologramRequest request;
        const LightField light_field = open_for_holograms(folder_ / "a.h5", request, false);
        try {
            photograph(light_field, std::vector{camera_for(0.3e-3, 0.3e-3, 8)});
            ADD_FAILURE() << "took " << value;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_input);
            EXPECT_NE(std::string(error.what()).find("hogel (2, 3) in direction (5, 4), channel 1"), std::string::npos)
                << error.what();
        }
    }
}

TEST_F(Pipeline, samples_that_are_no_numbers_are_not_taken_for_equal) {
    const FieldGrid grid{{700, 5, 1_um, 1_um, 0, 0}, 532_nm};
    const auto right = std::make_shared<Field>(grid), wrong = std::make_shared<Field>(grid);
    right->samples(1, 1) = 1;
    wrong->samples(1, 1) = 1;
    wrong->samples(2, 3) = {0, std::numeric_limits<float>::quiet_NaN()};
    for (const auto& [a, b] : {std::pair(right, wrong), {wrong, right}, {wrong, wrong}}) {
        const SampleComparison result = compare(Fields{a}, Fields{b});
        for (const double measure : {result.sqnr, result.psnr, result.max_error})
            EXPECT_TRUE(std::isnan(measure)) << measure;
    }
    const LightFieldGrid rays{3, 2, 1_mm, 4, 4, Perspective{0.1, 0.1}, 1};
    LightFieldBuffer dark(rays), broken(rays);
    broken.radiance(0, 1, 2, 3, 3) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(compare(borrow(dark), borrow(broken)).max_error));
}

// A file has a few kilobytes in addition to its samples.
TEST_F(Pipeline, plans_know_the_size_of_files) {
    const LightField light_field = rendered();
    for (const SampleType type : {SampleType::half, SampleType::single}) {
        LightFieldFileOptions file;
        file.type = type;
        write_light_field(folder_ / "a.h5", light_field, file);
        const double bytes = static_cast<double>(std::filesystem::file_size(folder_ / "a.h5"));
        const double planned = plan_light_field(light_field, request_, 1000, file).disk;
        EXPECT_GE(bytes, planned);
        EXPECT_LE(bytes, planned + 20'000);
        const HologramFileOptions hologram{.type = type};
        write_holograms(folder_ / "b.h5", make_holograms(light_field, holograms_), hologram);
        const double samples = static_cast<double>(std::filesystem::file_size(folder_ / "b.h5"));
        const double expected = plan_holograms(light_field.grids(), holograms_, hologram).disk;
        EXPECT_GE(samples, expected);
        EXPECT_LE(samples, expected + 20'000);
    }
}

TEST_F(Pipeline, what_does_not_fit_is_refused_with_the_numbers) {
    const auto message = [](const Plan& plan, const std::filesystem::path& file) -> std::string {
        try {
            require_resources(plan, "this", file);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message({1e6, 1e6, 1}, folder_ / "a"), "");
    EXPECT_NE(message({1e18, 0, 1}, {}).find("takes 1000 PB of memory"), std::string::npos)
        << message({1e18, 0, 1}, {});
    EXPECT_NE(message({0, 1e18, 1}, folder_ / "a").find("of disk"), std::string::npos);
}

TEST(Plan, of_photographs_by_rays_grows_with_the_points_of_the_pupil) {
    const std::vector<LightFieldGrid> grids = LightFieldRequest().grids();
    const Camera camera = camera_for(20e-3, 20e-3);
    const Plan few = plan_ray_photographs(grids, {&camera, 1}, {1 << 10});
    const Plan many = plan_ray_photographs(grids, {&camera, 1}, {1 << 20});
    EXPECT_NEAR(many.seconds / few.seconds, 1024, 1e-6);
    // The rays of few points are kept; each has positions of eight bytes in rows and columns.
    const double places = 2.0 * (static_cast<double>(camera.picture.width) + static_cast<double>(grids[0].hogels_s));
    EXPECT_NEAR(many.memory - few.memory, 32.0 * ((1 << 20) - (1 << 10)) - 8 * places * (1 << 10), 1);
    EXPECT_EQ(many.disk, 0);
    EXPECT_THROW(require_resources(plan_ray_photographs(grids, {&camera, 1}, {std::size_t{1} << 40}), "it"), Error);
}

TEST(Plan, of_oblique_projections_does_not_shrink_with_the_hogels) {
    LightFieldRequest request;
    request.renderer = "oblique";
    request.grid.hogels_s = request.grid.hogels_t = 1;
    const Scene scene = load_scene("sphere", request);
    const LightField rendered = render_light_field(scene, request);
    EXPECT_GT(plan_light_field(rendered, request, 10'000'000).seconds,
              100 * plan_light_field(rendered, request, 10'000).seconds);
    // Its copies of all triangles, and of those visible from a region.
    request.renderer = "simploid";
    EXPECT_GE(plan_light_field(rendered, request, 10'000'000).memory,
              plan_light_field(rendered, request, 10'000).memory + 156.0 * 9'990'000);
}

TEST(Plan, has_no_time_for_shading_at_samples) {
    LightFieldRequest request;
    request.grid.hogels_s = request.grid.hogels_t = 1;
    const LightField rendered = render_light_field(load_scene("sphere", request), request);
    for (const auto& [model, is_known] : {std::pair("vertex", true), {"shadowed", false}, {"direct", false}}) {
        request.shading.model = model;
        EXPECT_EQ(plan_light_field(rendered, request, 1000).seconds > 0, is_known) << model;
    }
}

TEST(Plan, of_exports_holds_all_views_that_are_written_at_once) {
    const LightFieldBuffer black(LightFieldGrid{30, 20, 1e-3, 4, 4, Perspective{0.1, 0.1}, 3});
    const LightField light_field = borrow(black);
    const auto memory = [&](const char* layout) { return plan_export(light_field, {.layout = layout}).memory; };
    EXPECT_EQ(memory("mat"), memory("npy") + 4 * light_field.samples());
    EXPECT_EQ(memory("quilt"), memory("mat"));
    EXPECT_EQ(memory("rows-columns"), memory("npy"));
}

TEST(Plan, of_compression_refuses_what_compression_refuses) {
    const LightFieldBuffer black(LightFieldGrid{30, 20, 1e-3, 4, 4, Perspective{0.1, 0.1}, 3});
    const LightField light_field = borrow(black);
    CompressionOptions options;
    const double memory = plan_compression(light_field, options).memory;
    for (const CompressionTarget& exact : std::vector<CompressionTarget>{Lossless{}, MaxError{1e-3}}) {
        options.target = exact;
        EXPECT_EQ(plan_compression(light_field, options).memory, memory);
    }
    options.method.coder = "ezw";
    EXPECT_THROW(plan_compression(light_field, options), Error);
}

TEST(Plan, of_lines_behind_a_diffuser_grows_with_the_lines_that_overlap) {
    const Camera camera = camera_for(1e-3, 1e-3, 32);
    const auto plan = [&](std::size_t lines, bool diffuser) {
        const FieldGrid grid{{640, lines, 1.5625e-6, 1e-3 / static_cast<double>(lines), 0, 0}, 633e-9};
        return plan_photographs(std::span(&grid, 1), 1, {&camera, 1}, BandCamera{.vertical_diffuser = diffuser});
    };
    EXPECT_GT(plan(640, true).seconds, 5 * plan(64, true).seconds);
    EXPECT_GT(plan(640, true).seconds, 20 * plan(640, false).seconds);
    EXPECT_GT(plan(640, true).memory, 0);
}

TEST(Plan, of_photographs_counts_what_they_are_computed_from) {
    const LightFieldGrid grid{100, 100, 50e-6, 32, 32, Perspective{0.14, 0.14}, 3};
    const std::span<const LightFieldGrid> faces(&grid, 1);
    HologramRequest request;
    request.looks = 16;
    Camera camera = camera_for(5e-3, 5e-3, 100);
    const auto from = [&](const CameraModel& model) {
        return choose_band_source(faces, request, {&camera, 1}, model).source;
    };
    const auto seconds = [&](const CameraModel& model) {
        return plan_photographs(faces, request, {&camera, 1}, model).seconds;
    };
    EXPECT_EQ(from(BandCamera()), BandSource::hogel_spectra);
    EXPECT_EQ(from(BandCamera{.source = BandSource::samples}), BandSource::samples);
    EXPECT_LT(1.5 * seconds(BandCamera()), seconds(BandCamera{.source = BandSource::samples}));
    EXPECT_LT(4 * seconds(SpeckleFreeCamera()), seconds(BandCamera()));
    // At this small distance, more than half of a hogel's samples enter the pupil.
    camera.eye.z = 60e-3;
    EXPECT_EQ(from(BandCamera()), BandSource::samples);
    EXPECT_EQ(from(SpeckleFreeCamera()), BandSource::hogel_spectra);
    camera.eye.z = 300e-3;
    for (const HologramMethod& known : std::vector<HologramMethod>{PhaseAdded{}, Basis{}, OverlapAdd{}}) {
        request.method = known;
        EXPECT_EQ(from(BandCamera()), BandSource::hogel_spectra);
    }
    request.method = PhaseAdded{true};
    EXPECT_EQ(from(BandCamera()), BandSource::samples);
}

}  // namespace
}  // namespace hogel::pipeline
