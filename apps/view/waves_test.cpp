// SPDX-License-Identifier: Apache-2.0
#include "view/waves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stop_token>
#include <vector>

#include "hogel/error.h"
#include "view/hologram_viewable.h"
#include "view/light_field_viewable.h"

namespace hogel::view {
namespace {

constexpr std::size_t all_looks = 3;

LightField ramp() {
    const LightFieldGrid grid{24, 20, 0.25e-3, 8, 8, Perspective{0.08, 0.08}, 1};
    auto buffer = std::make_shared<LightFieldBuffer>(grid, false);
    for (std::size_t i = 0; i < buffer->radiance.size(); ++i)
        buffer->radiance.data()[i] = 0.5f + 0.001f * static_cast<float>(i % 701);
    return LightField(buffer);
}

Fields holograms(std::size_t looks) {
    HologramRequest request;
    request.channels = mono(633e-9);
    request.pitch = 2.5e-6;
    request.looks = looks;
    return make_holograms(ramp(), request);
}

std::unique_ptr<Waves> waves(int* made = nullptr) {
    const auto make = [made] {
        if (made != nullptr) ++*made;
        return holograms(all_looks);
    };
    return std::make_unique<Waves>(make, all_looks, std::size_t{1} << 28, Progress());
}

std::unique_ptr<LightFieldViewable> viewable() {
    return std::make_unique<LightFieldViewable>(ramp(), ramp(), std::size_t{1} << 28, Progress(), waves());
}

PictureQuery view_by(PictureMethod by) {
    PictureQuery query;
    query.camera.eye = {2e-3, -1e-3, 0.12};
    query.camera.pupil = 3e-3;
    query.camera.resolution = {48, 40};
    query.by = by;
    return query;
}

Image expected(const Camera& camera, std::size_t looks, const BandCamera& options = {}) {
    return photograph_colours(holograms(looks), {&camera, 1}, options).front();
}

bool equal(const Image& a, const Image& b) { return std::ranges::equal(a.pixels.elements(), b.pixels.elements()); }

// Picture n is the mean of n looks, as with --looks n.
TEST(Waves, refine_look_by_look) {
    const auto one = viewable();
    std::vector<std::size_t> shown;
    one->photograph(view_by(PictureMethod::waves),
                    [&](const Photograph& photograph) {
                        shown.push_back(photograph.looks);
                        EXPECT_TRUE(equal(photograph.picture,
                                          expected(one->camera(view_by(PictureMethod::waves)), photograph.looks)))
                            << photograph.looks;
                    },
                    {});
    EXPECT_EQ(shown, (std::vector<std::size_t>{1, 2, 3}));
}

TEST(Waves, stop_after_the_looks_that_are_wanted) {
    int made = 0;
    const auto one = waves(&made);
    const Camera camera = viewable()->camera(view_by(PictureMethod::waves));
    EXPECT_EQ(made, 0);
    for (const std::size_t wanted : {1, 2, 1, 3}) {
        std::size_t last = 0;
        one->photograph(camera, wanted, false, [&](const Image&, std::size_t looks) { last = looks; }, {});
        EXPECT_EQ(last, wanted);
    }
    EXPECT_EQ(made, 1);
}

// A preview in motion is not reused for the picture of the same viewpoint at rest.
TEST(Waves, are_previews_where_that_is_asked_for) {
    const auto one = viewable();
    PictureQuery query = view_by(PictureMethod::waves);
    query.looks = 1;
    query.preview = true;
    const Image preview = one->photograph(query, {}).picture;
    query.preview = false;
    const Image whole = one->photograph(query, {}).picture;
    const Camera camera = one->camera(query);
    EXPECT_TRUE(equal(whole, expected(camera, 1)));
    EXPECT_TRUE(equal(preview, expected(camera, 1, {.preview = true})));
    EXPECT_FALSE(equal(preview, whole));
}

TEST(Waves, stop_for_a_newer_view) {
    const auto one = waves();
    const Camera camera = viewable()->camera(view_by(PictureMethod::waves));
    std::stop_source newer;
    std::size_t last = 0;
    const auto until_first = [&](const Image&, std::size_t looks) {
        last = looks;
        newer.request_stop();
    };
    EXPECT_THROW(one->photograph(camera, 0, false, until_first, Progress(newer.get_token())), Error);
    EXPECT_EQ(last, 1u);
    one->photograph(camera, 0, false, [&](const Image&, std::size_t looks) { last = looks; }, {});
    EXPECT_EQ(last, all_looks);
}

TEST(Waves, stand_beside_rays) {
    const auto one = viewable();
    const Image rays = one->photograph(view_by(PictureMethod::rays), {}).picture;
    const Image by_waves = one->photograph(view_by(PictureMethod::waves), {}).picture;
    const Photograph both = one->photograph(view_by(PictureMethod::side), {});
    ASSERT_EQ(both.picture.width(), 96u);
    const Photograph apart = one->photograph(view_by(PictureMethod::difference), {});
    ASSERT_EQ(apart.picture.width(), 48u);
    for (std::size_t y = 0; y < 40; ++y)
        for (std::size_t x = 0; x < 48; ++x) {
            EXPECT_EQ(both.picture.pixels(y, x, 0), rays.pixels(y, x, 0));
            EXPECT_EQ(both.picture.pixels(y, 48 + x, 0), by_waves.pixels(y, x, 0));
            EXPECT_EQ(apart.picture.pixels(y, x, 0), std::abs(rays.pixels(y, x, 0) - by_waves.pixels(y, x, 0)));
        }
    ASSERT_TRUE(apart.psnr);
    EXPECT_EQ(*apart.psnr, compare(by_waves, rays, one->exposure()).psnr);
    // A spot of the right half is of the same ray as one of the left half.
    EXPECT_EQ(one->read(view_by(PictureMethod::side), {0.75, 0.5}).across,
              one->read(view_by(PictureMethod::rays), {0.5, 0.5}).across);
}

TEST(Waves, of_two_eyes_are_two_pictures) {
    const auto one = viewable();
    PictureQuery both = view_by(PictureMethod::waves), left = both;
    both.eyes = 4e-3;
    left.camera.eye.x -= 2e-3;
    std::vector<std::size_t> shown;
    Photograph last;
    one->photograph(both,
                    [&](const Photograph& photograph) {
                        shown.push_back(photograph.looks);
                        last = photograph;
                    },
                    {});
    EXPECT_EQ(shown, (std::vector<std::size_t>{1, all_looks}));
    const Image alone = one->photograph(left, {}).picture;
    for (std::size_t x = 0; x < 48; ++x) EXPECT_EQ(last.picture.pixels(20, x, 0), alone.pixels(20, x, 0));
}

TEST(Waves, are_refused_where_there_are_none) {
    LightFieldViewable coarse(ramp(), ramp(), std::size_t{1} << 28, Progress());
    EXPECT_THROW(coarse.require(view_by(PictureMethod::waves)), Error);
    HologramViewable hologram(holograms(1), std::size_t{1} << 30, Progress());
    EXPECT_THROW(hologram.require(view_by(PictureMethod::rays)), Error);
    EXPECT_THROW(hologram.require(view_by(PictureMethod::side)), Error);
    PictureQuery stereo = view_by(PictureMethod::difference);
    stereo.eyes = 6e-3;
    EXPECT_THROW(viewable()->require(stereo), Error);
    EXPECT_NO_THROW(hologram.require(view_by(PictureMethod::waves)));
}

}  // namespace
}  // namespace hogel::view
