// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline/picture_jobs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "hogel/resume.h"
#include "hogel/units.h"

namespace hogel::pipeline {
namespace {

using namespace hogel::literals;

const CameraModel looks = BandCamera(), expected = SpeckleFreeCamera();

// Five viewpoints with two focuses each, of a hologram in three colours.
class PictureJobsTest : public testing::Test {
  protected:
    PictureJobsTest() {
        HologramRequest of;
        of.channels = rgb(633_nm, 532_nm, 460_nm);
        of.pitch = 1.5625_um;
        of.looks = 16;
        holograms_ = make_holograms(light_field_, of);
        for (const double depth : {-1_mm, 2_mm})
            for (const double x : {-10_mm, -5_mm, 0_mm, 5_mm, 10_mm}) {
                cameras_.push_back(camera_for(2_mm, 2_mm, 64));
                cameras_.back().eye.x = x;
                cameras_.back().focus_depth = depth;
            }
    }
    std::vector<PictureJob> jobs(const std::vector<CameraModel>& ways) const {
        return picture_jobs(holograms_, order_, cameras_, ways);
    }

    static LightField rendered() {
        LightFieldRequest request;
        request.grid = {8, 8, 0.25_mm, 32, 32, field_of_view(16_deg)};
        return render_light_field(load_scene("sphere", request), request);
    }

    LightField light_field_ = rendered();
    Fields holograms_;
    std::vector<Camera> cameras_;
    std::vector<std::size_t> order_{2, 1, 0};
};

TEST_F(PictureJobsTest, are_all_colours_in_order_where_pictures_are_neither_shared_nor_kept) {
    const std::vector<std::size_t> cameras{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    const std::vector<PictureJob> all{{0, {2, 1, 0}, cameras}, {1, {2, 1, 0}, cameras}};
    EXPECT_EQ(jobs({looks, expected}), all);
}

TEST_F(PictureJobsTest, are_those_of_four_eyes_where_pictures_without_speckle_are_kept) {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / ("picture_jobs_" + std::to_string(::getpid()));
    ResumeScope kept(file, {});
    const std::vector<PictureJob> all = jobs({looks, expected});
    ASSERT_EQ(all.size(), 3u + 6u);
    EXPECT_EQ(all[2], (PictureJob{0, {0}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}));
    EXPECT_EQ(all[3], (PictureJob{1, {2}, {0, 5, 1, 6, 2, 7, 3, 8}}));
    EXPECT_EQ(all[8], (PictureJob{1, {0}, {4, 9}}));
    kept.complete();
}

TEST_F(PictureJobsTest, are_none_of_cameras_that_need_samples) {
    EXPECT_TRUE(jobs({PlaneWaveCamera()}).empty());
    EXPECT_TRUE(jobs({BandCamera{.source = BandSource::samples}}).empty());
    EXPECT_TRUE(jobs({BandCamera{.vertical_diffuser = true}}).empty());
}

// Pictures do not depend on the jobs.
TEST_F(PictureJobsTest, do_not_change_pictures) {
    const std::vector<CameraModel> ways{looks, expected};
    const auto all = photograph_colours(holograms_, cameras_, ways);
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / ("picture_jobs_" + std::to_string(::getpid()));
    ResumeScope kept(file, {});
    const auto by_jobs = photograph_colours(holograms_, cameras_, ways);
    kept.complete();
    for (std::size_t model_index = 0; model_index < ways.size(); ++model_index)
        for (std::size_t i = 0; i < cameras_.size(); ++i)
            EXPECT_TRUE(
                std::ranges::equal(all[model_index][i].pixels.elements(), by_jobs[model_index][i].pixels.elements()))
                << model_index << " " << i;
}

}  // namespace
}  // namespace hogel::pipeline
