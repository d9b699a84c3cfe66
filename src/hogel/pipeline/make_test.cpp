// SPDX-License-Identifier: Apache-2.0
#include "hogel/make.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>

#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::pipeline {
namespace {

using namespace hogel::literals;

MakeRequest small_request() {
    MakeRequest request;
    request.light_field.grid = {16, 16, 62.5_um, 12, 12, field_of_view(16_deg)};
    request.eye_distance = 100_mm;
    request.pupil = 4_mm;
    request.resolution = 24;
    request.hologram.looks = 1;
    request.rays = {16};
    return request;
}

bool equal(const Image& a, const Image& b) { return std::ranges::equal(a.pixels.elements(), b.pixels.elements()); }

class Make : public ::testing::Test {
  protected:
    Make() {
        std::string name = std::filesystem::temp_directory_path() / "hogel_make_XXXXXX";
        folder_ = mkdtemp(name.data());
    }
    ~Make() override { std::filesystem::remove_all(folder_); }

    MakeRequest request_ = small_request();
    Scene scene_ = load_scene("sphere", request_.light_field);
    std::filesystem::path folder_;
};

// Calls the steps of the pipeline one by one.
TEST_F(Make, is_the_pipeline_in_one_call) {
    const Made made = make(scene_, request_);
    const MakeRequest resolved = resolve(request_, bounds(scene_));
    const std::vector<Camera> cameras = cameras_of(resolved);
    ASSERT_EQ(made.photographs.size(), 6u);
    ASSERT_EQ(made.holograms.size(), 3u);
    const std::vector<Image> rays = photograph(made.light_field, cameras, request_.rays),
                             waves = photograph_colours(made.holograms, cameras),
                             speckle_free = photograph_colours(made.holograms, cameras, SpeckleFreeCamera());
    EXPECT_EQ(made.exposure, automatic_exposure(rays[1]));
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const MadePhotographs& by = made.photographs[i];
        EXPECT_EQ(by.camera.camera, cameras[i]);
        ASSERT_TRUE(by.waves && by.speckle_free);
        EXPECT_TRUE(equal(by.rays, rays[i])) << i;
        EXPECT_TRUE(equal(by.waves->image, waves[i])) << i;
        EXPECT_TRUE(equal(by.speckle_free->image, speckle_free[i])) << i;
        EXPECT_EQ(by.waves->comparison.psnr, compare(rays[i], waves[i], made.exposure).psnr);
        EXPECT_EQ(by.speckle_free->comparison.ssim, compare(rays[i], speckle_free[i], made.exposure).ssim);
        // Speckle-free photographs are closer to those of the light field.
        EXPECT_GT(by.speckle_free->comparison.psnr, by.waves->comparison.psnr);
    }
}

TEST_F(Make, pictures_do_not_depend_on_files) {
    const Made memory = make(scene_, request_);
    MakeOptions files;
    files.light_field_file = folder_ / "lightfield.h5";
    files.hologram_file = folder_ / "hologram.h5";
    std::vector<std::string> stages;
    files.stage = [&](const std::string& stage) {
        stages.push_back(stage);
        return Progress();
    };
    const Made stored = make(scene_, request_, files);
    EXPECT_EQ(stages, (std::vector<std::string>{"lighting", "light field", "photographs by rays", "hologram file",
                                                "photographs by waves", "speckle-free photographs"}));
    EXPECT_EQ(compare(open_light_field(files.light_field_file), memory.light_field).max_error, 0);
    EXPECT_EQ(compare(open_hologram(files.hologram_file), memory.holograms).max_error, 0);
    EXPECT_EQ(stored.exposure, memory.exposure);
    for (std::size_t i = 0; i < memory.photographs.size(); ++i) {
        EXPECT_TRUE(equal(stored.photographs[i].rays, memory.photographs[i].rays));
        EXPECT_TRUE(equal(stored.photographs[i].waves->image, memory.photographs[i].waves->image));
    }
    write_photographs(folder_, memory, {.waves = {{"by", "waves"}}, .speckle_free = {}, .rays = {}});
    for (const MadePhotographs& by : memory.photographs)
        for (const std::string& name : {by.camera.wave_file(), by.camera.speckle_free_file(), by.camera.ray_file()})
            for (const char* extension : {".png", ".exr"})
                EXPECT_EQ(read_image(folder_ / (name + extension)).provenance.camera, by.camera.camera);
    const Metadata entries = read_metadata(folder_ / "photo_high_far.png");
    EXPECT_TRUE(std::ranges::count(entries, std::pair<std::string, std::string>("by", "waves")));
}

TEST_F(Make, photographs_what_the_request_names) {
    request_.cameras = {{"middle", "plane", camera_for(1_mm, 1_mm, 16)}};
    request_.cameras[0].camera.pupil = 8_mm;
    request_.camera = SpeckleFreeCamera();
    const Made made = make(scene_, request_);
    ASSERT_EQ(made.photographs.size(), 1u);
    EXPECT_FALSE(made.photographs[0].waves);
    EXPECT_TRUE(made.photographs[0].speckle_free);
    EXPECT_EQ(made.photographs[0].camera.wave_file(), "photo_middle_plane");
    EXPECT_EQ(made.exposure, automatic_exposure(made.photographs[0].rays));

    request_.camera = BandCamera();
    request_.speckle_free = false;
    request_.hologram.channels = {{532_nm, 0}};
    // Holograms are made of any light field, not only of one of a scene.
    request_.light_field.grid.channels = 1;
    const Made bright =
        make(light_field_from(request_.light_field.grid, [](double, double, double, double) { return 2; }), request_);
    EXPECT_TRUE(bright.photographs[0].waves);
    EXPECT_FALSE(bright.photographs[0].speckle_free);
    EXPECT_NEAR(bright.photographs[0].rays.pixels(8, 8, 0), 2, 1e-6);
}

TEST_F(Make, methods_that_need_depth_have_it) {
    request_.hologram.method = OverlapAdd();
    request_.hologram.channels = {{532_nm, 1}};
    request_.light_field.grid.hogels_s = request_.light_field.grid.hogels_t = 8;
    request_.cameras = {{"middle", "plane", camera_for(1_mm, 1_mm, 16)}};
    const Made made = make(scene_, request_);
    EXPECT_TRUE(made.light_field.has_depth());
    EXPECT_FALSE(made.photographs[0].speckle_free);  // this method does not support it
    // The picture by rays has the channel of the single wavelength.
    const Image all = photograph(made.light_field, request_.cameras[0].camera, request_.rays);
    EXPECT_EQ(made.photographs[0].rays.channels(), 1u);
    EXPECT_EQ(made.photographs[0].rays.pixels(8, 8, 0), all.pixels(8, 8, 1));
}

TEST(MakeRequest, is_resolved_once) {
    MakeRequest request = small_request();
    request.hologram.looks = 0;
    request.light_field.grid.view = field_of_view(40_deg);
    const Bounds scene{{-1_mm, -1_mm, -5_mm}, {1_mm, 1_mm, 1_mm}};
    const MakeRequest resolved = resolve(request, scene), again = resolve(resolved, scene);
    EXPECT_EQ(resolved.hologram.looks, enough_looks(resolved.cameras[0].camera));
    EXPECT_LT(resolved.hologram.pitch, request.hologram.pitch);
    EXPECT_NO_THROW(require_holograms(resolved.light_field.grids(), resolved.hologram, {}));
    EXPECT_EQ(again.hologram.looks, resolved.hologram.looks);
    EXPECT_EQ(again.hologram.pitch, resolved.hologram.pitch);
    EXPECT_EQ(cameras_of(again), cameras_of(resolved));
    request.adapt_pitch = false;
    EXPECT_EQ(resolve(request, scene).hologram.pitch, request.hologram.pitch);
    request.camera = SpeckleFreeCamera();
    EXPECT_EQ(resolve(request, scene).hologram.looks, 1u);
    request.hologram.looks = 0;
    EXPECT_THROW(
        make(light_field_from(request.light_field.grid, [](double, double, double, double) { return 1; }), request),
        Error);
}

TEST(DefaultFocuses, are_within_the_scene_and_before_the_eye) {
    const auto depths = [](double front, double back) {
        const auto [near, far] = default_focuses({{0, 0, -back}, {1, 1, -front}}, 300_mm);
        EXPECT_EQ(near.name, "near");
        EXPECT_EQ(far.name, "far");
        return std::pair{near.depth, far.depth};
    };
    for (const auto& [front, back] : {std::pair{-2_mm, 10_mm}, {1_mm, 1_mm}, {5_mm, 2000_mm}, {-600_mm, 100_mm}}) {
        const auto [near, far] = depths(front, back);
        EXPECT_GE(near, std::max(front, -150_mm));
        EXPECT_LE(near, far);
        EXPECT_LE(far, back);
        // As far from its end of the scene as the other focus, unless that is too close to the eye.
        EXPECT_TRUE(near == -150_mm || std::abs((near - front) - (back - far)) < 1e-12) << near;
    }
}

// For every viewpoint, all points of the pupil are in the field of view of every hogel, with a margin.
TEST(DefaultEyes, see_the_whole_hologram_with_the_whole_pupil) {
    const double distance = 60_mm, pupil = 3_mm;
    for (const LightFieldGrid& grid : {LightFieldGrid{40, 40, 100_um, 16, 16, field_of_view(16_deg)},
                                       LightFieldGrid{40, 20, 100_um, 16, 16, field_of_view(16_deg, 12_deg)},
                                       LightFieldGrid{10, 30, 100_um, 16, 16, field_of_view(12_deg, 14_deg)}}) {
        const auto eyes = default_eyes(grid, distance, pupil);
        for (const NamedEye& eye : eyes) {
            const double x = std::abs(eye.position.x) + 0.5 * pupil + 0.5 * grid.width(),
                         y = std::abs(eye.position.y) + 0.5 * pupil + 0.5 * grid.height();
            EXPECT_LT(x, distance * grid.half_u()) << eye.name;
            EXPECT_LT(y, distance * grid.half_v()) << eye.name;
            EXPECT_GT(std::max(std::abs(eye.position.x), std::abs(eye.position.y)), 0.1 * pupil) << eye.name;
            EXPECT_EQ(eye.position.z, distance);
        }
        EXPECT_LT(eyes[0].position.x, 0);
        EXPECT_GT(eyes[1].position.y, 0);
        EXPECT_EQ(eyes[2].position.x, -eyes[0].position.x);
    }
    try {
        default_eyes({40, 40, 100_um, 16, 16, field_of_view(16_deg)}, 20_mm, pupil);
        ADD_FAILURE() << "the field of view is too narrow there";
    } catch (const Error& error) {
        EXPECT_EQ(error.parameter(), "eye_distance");
    }
}

TEST(SpeckleFree, is_cheap_where_hogels_are_small_and_known_for_random_phases_alone) {
    const LightFieldGrid grid{100, 100, 50_um, 32, 32, field_of_view(16_deg)};
    const Camera camera = camera_for(5_mm, 5_mm, 100);
    HologramRequest hologram;
    const auto cheap = [&] { return is_speckle_free_cheap({&grid, 1}, hologram, {&camera, 1}); };
    EXPECT_TRUE(cheap());
    hologram.method = Fourier{.phases = Phases::fixed};
    EXPECT_FALSE(cheap());
    hologram.method = PhaseAdded();
    EXPECT_FALSE(cheap());
}

}  // namespace
}  // namespace hogel::pipeline
