// SPDX-License-Identifier: Apache-2.0
#include "hogel/pipeline/picture_shares.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "hogel/units.h"

namespace hogel::pipeline {
namespace {

using namespace hogel::literals;

const WaveCamera looks = PhotographOptions(), expected = PhotographOptions{.expected = true};

// Three eyes with two focuses each, of a hologram in three colours.
class PictureJobsTest : public testing::Test {
  protected:
    PictureJobsTest() {
        HologramRequest of;
        of.channels = rgb(633_nm, 532_nm, 460_nm);
        of.pitch = 1.5625_um;
        of.looks = 16;
        holograms_ = make_holograms(light_field_, of);
        for (const double depth : {-1_mm, 2_mm})
            for (const double x : {-10_mm, 0_mm, 10_mm}) {
                cameras_.push_back(camera_for(2_mm, 2_mm, 64));
                cameras_.back().eye.x = x;
                cameras_.back().focus_depth = depth;
            }
    }
    std::vector<PictureJob> jobs(std::size_t processes, const std::vector<WaveCamera>& ways) const {
        return jobs_of(processes, holograms_, order_, cameras_, ways);
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

TEST_F(PictureJobsTest, have_each_picture_once_and_end_together) {
    std::size_t possible = 0, divided = 0;
    for (const std::vector<WaveCamera>& ways :
         {std::vector{looks}, std::vector{expected}, std::vector{looks, expected}})
        for (std::size_t processes = 2; processes < 9; ++processes) {
            const std::vector<PictureJob> all = jobs(processes, ways);
            if (all.empty()) continue;
            ++possible;
            std::map<std::tuple<std::size_t, std::size_t, std::size_t>, int> pictures;
            double sum = 0;
            for (const PictureJob& job : all) {
                sum += job.cost;
                divided += job.pictures.cameras.size() < cameras_.size() ? 1 : 0;
                for (const std::size_t camera : job.pictures.cameras)
                    ++pictures[{job.way, job.pictures.colour, camera}];
            }
            EXPECT_EQ(pictures.size(), ways.size() * holograms_.size() * cameras_.size());
            for (const auto& [picture, count] : pictures) EXPECT_EQ(count, 1);
            EXPECT_LE(end_of(all, processes), 1.11 * sum / static_cast<double>(processes));
        }
    EXPECT_GE(possible, 3u);
    EXPECT_GT(divided, 0u);
}

TEST_F(PictureJobsTest, are_whole_colours_and_then_fewer_and_fewer_pictures_of_infinitely_many_looks) {
    const std::vector<PictureJob> all = jobs(2, {looks, expected});
    ASSERT_GE(all.size(), 6u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(all[i].way, 0u);
        EXPECT_EQ(all[i].pictures.colour, order_[i]);
        EXPECT_EQ(all[i].pictures.cameras.size(), cameras_.size());
    }
    for (std::size_t i = 3; i < all.size(); ++i) {
        EXPECT_EQ(all[i].way, 1u);
        const PictureShare &some = all[i].pictures, &before = all[i - 1].pictures;
        EXPECT_TRUE(some.colour != before.colour || some.cameras.size() <= before.cameras.size());
    }
    // Cameras of an eye follow each other.
    EXPECT_EQ(all[3].pictures.cameras[0] % 3, all[3].pictures.cameras[1] % 3);
}

TEST_F(PictureJobsTest, are_none_where_colours_cannot_be_divided_evenly) {
    EXPECT_TRUE(jobs(1, {looks, expected}).empty());
    EXPECT_TRUE(jobs(2, {looks}).empty());
    EXPECT_TRUE(jobs(9, {looks}).empty());
    EXPECT_TRUE(jobs(2, {looks, PlaneWaveCameraOptions()}).empty());
    EXPECT_TRUE(jobs(2, {PhotographOptions{.from = LightFrom::samples}, expected}).empty());
    // An eye's band is that of its widest pupil, so that its pictures are not made one by one.
    cameras_.front().pupil *= 0.5;
    for (const PictureJob& job : jobs(3, {expected})) EXPECT_EQ(job.pictures.cameras.size(), cameras_.size());
}

TEST(PictureJobs, are_taken_by_whoever_is_free) {
    const auto job = [](double cost) { return PictureJob{0, {}, cost}; };
    EXPECT_EQ(end_of(std::vector{job(3), job(2), job(2), job(1)}, 2), 4);
    EXPECT_EQ(end_of(std::vector{job(3), job(2), job(2), job(1)}, 1), 8);
    EXPECT_EQ(end_of(std::vector{job(1), job(1), job(3)}, 2), 4);
    EXPECT_EQ(end_of({}, 3), 0);
}

}  // namespace
}  // namespace hogel::pipeline
