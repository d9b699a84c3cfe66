// SPDX-License-Identifier: Apache-2.0
// Photographs from one viewpoint after the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stop_token>

#include "hogel/camera/photograph_together.h"
#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/photograph.h"
#include "hogel/stereogram/test_light_fields.h"
#include "hogel/units.h"

namespace hogel::camera {
namespace {

using namespace literals;
using namespace stereogram;

double stripes(Vec3 hogel, Vec3 direction) {
    return 0.6 + 0.4 * std::sin(2 * std::numbers::pi * (hogel.x / 290e-6 + 3 * direction.y / direction.z));
}

// Counts the reads of its light field.
class Counted final : public LightFieldSource {
  public:
    explicit Counted(LightFieldBuffer light_field) : light_field_(std::move(light_field)) {}
    const LightFieldGrid& grid() const override { return light_field_.grid(); }
    bool has_depth() const override { return false; }
    void read(LightFieldTile& tile) const override {
        ++readings;
        light_field_.read(tile);
    }
    mutable std::atomic<std::size_t> readings = 0;

  private:
    LightFieldBuffer light_field_;
};

struct Setting {
    std::shared_ptr<Counted> light_field =
        std::make_shared<Counted>(light_field_of({24, 22, 48_um, 24, 24, Perspective{0.15, 0.15}, 1}, stripes));
    std::shared_ptr<const FieldSource> hologram =
        make_hologram(LightField(LightField::Source(light_field)), {{532_nm, 0}, 1.5_um, Fourier{}, 4, 7});
    Camera camera() const {
        Camera camera;
        camera.eye = {1_mm, -1_mm, 30_mm};
        camera.pupil = 0.7_mm;
        camera.focus_depth = 1_mm;
        camera.picture = {32, 32, 36_um, 36_um, 0, 0};
        return camera;
    }
};

double distance(const Image& a, const Image& b) {
    double sum = 0, light = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        sum += std::pow(double(a.pixels.data()[i]) - double(b.pixels.data()[i]), 2);
        light += std::pow(double(b.pixels.data()[i]), 2);
    }
    return std::sqrt(sum / light);
}

TEST(EyePhotographer, takes_the_photographs_of_all_eyes_from_one_reading) {
    const Setting s;
    EyePhotographer photographer({s.hologram});
    const std::size_t readings = s.light_field->readings;
    for (const double x : {1_mm, -2_mm})
        for (const double focus : {1_mm, 0_mm, -1.2_mm}) {
            Camera camera = s.camera();
            camera.eye.x = x;
            camera.focus_depth = focus;
            const Image picture = photographer.photograph(camera);
            // Films have the size of the widest blur so far, which changes pictures by interpolation only.
            EXPECT_LT(distance(picture, photograph(*s.hologram, {&camera, 1}).front()), 4e-3) << x << " " << focus;
        }
    EXPECT_GT(readings, 0u);
    EXPECT_EQ(s.light_field->readings, readings);
}

// Pictures of the same viewpoint that show more or less of the surroundings of the hologram.
TEST(EyePhotographer, shows_the_surroundings_as_other_photographs_do) {
    const Setting s;
    EyePhotographer photographer({s.hologram});
    for (const double pixel : {36_um, 60_um, 48_um}) {
        Camera camera = s.camera();
        camera.focus_depth = 2_mm;
        camera.picture.pitch_x = camera.picture.pitch_y = pixel;
        EXPECT_LT(distance(photographer.photograph(camera), photograph(*s.hologram, {&camera, 1}).front()), 4e-3)
            << pixel;
    }
}

TEST(EyePhotographer, shows_the_mean_of_the_looks_so_far) {
    const Setting s;
    EyePhotographer photographer({s.hologram, s.hologram, s.hologram});
    std::vector<Image> shown;
    const Image last = photographer.photograph(s.camera(), [&](const Image& picture, std::size_t looks) {
        EXPECT_EQ(looks, shown.size() + 1);
        shown.push_back(picture);
    });
    ASSERT_EQ(shown.size(), 4u);
    EXPECT_EQ(last.channels(), 3u);
    EXPECT_LT(distance(shown.back(), last), 1e-6);
    EXPECT_GT(distance(shown.front(), last), 2 * distance(shown[2], last));
}

// Fields with known samples only; narrower pupils need no new light.
TEST(EyePhotographer, takes_photographs_of_samples) {
    const Setting s;
    const Grid& plane = s.hologram->grid().plane;
    const auto field = std::make_shared<Field>(s.hologram->grid());
    s.hologram->read({0, 0, plane.width, plane.height}, 0, field->samples);
    EyePhotographer photographer({field});
    for (const double pupil : {0.7_mm, 0.4_mm, 0.9_mm}) {
        Camera camera = s.camera();
        camera.pupil = pupil;
        EXPECT_LT(distance(photographer.photograph(camera), photograph(*field, {&camera, 1}).front()), 4e-3) << pupil;
    }
}

TEST(EyePhotographer, continues_after_a_stop) {
    const Setting s;
    EyePhotographer photographer({s.hologram});
    std::stop_source stop;
    std::size_t seen = 0;
    EXPECT_THROW(photographer.photograph(
                     s.camera(), [&](const Image&, std::size_t looks) { (seen = looks) == 2 && stop.request_stop(); },
                     Progress(stop.get_token())),
                 Error);
    EXPECT_EQ(seen, 2u);
    const Image picture = photographer.photograph(s.camera());
    const Camera camera = s.camera();
    EXPECT_LT(distance(picture, photograph(*s.hologram, {&camera, 1}).front()), 4e-3);
}

// Three colours of a light field that is not in memory share its rays, and their pictures are those of each by itself.
TEST(PhotographTogether, makes_rays_once_for_all_colours) {
    LightFieldBuffer rays(LightFieldGrid{70, 22, 48_um, 24, 24, Perspective{0.15, 0.15}, 3});
    for (std::size_t i = 0; i < rays.radiance.size(); ++i)
        rays.radiance.data()[i] = static_cast<float>(1 + std::sin(0.001 * static_cast<double>(i)));
    const auto source = std::make_shared<Counted>(std::move(rays));
    const auto in_colours = [&](std::size_t looks) {
        std::vector<std::shared_ptr<const FieldSource>> colours;
        for (std::size_t c = 0; c < 3; ++c)
            colours.push_back(
                make_hologram(LightField(LightField::Source(source)),
                              {{630_nm - 80_nm * static_cast<double>(c), c}, 1.5_um, Fourier{}, looks, 7}));
        return colours;
    };
    const auto colours = in_colours(3);
    std::vector<Camera> cameras(3, Setting().camera());
    for (Camera& camera : cameras) camera.pupil = 0.5_mm;
    cameras[1].focus_depth = -1_mm;
    cameras[1].picture.pitch_x = cameras[1].picture.pitch_y = 50_um;
    cameras[2].eye.x = -2_mm;
    std::vector<std::vector<Image>> alone;
    source->readings = 0;
    for (const auto& colour : colours) alone.push_back(photograph(*colour, cameras));
    const std::size_t readings = source->readings;
    source->readings = 0;
    const auto together = camera::photograph_together(colours, cameras, {}, {});
    ASSERT_TRUE(together);
    EXPECT_EQ(3 * source->readings, readings);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < cameras.size(); ++i)
            EXPECT_TRUE(std::ranges::equal((*together)[c][i].pixels.elements(), alone[c][i].pixels.elements()));
    // Not from samples, nor for one colour, nor for so many looks that new memory takes more time than rays.
    EXPECT_FALSE(camera::photograph_together(colours, cameras, {.source = BandSource::samples}, {}));
    EXPECT_FALSE(camera::photograph_together({colours.data(), 1}, cameras, {}, {}));
    EXPECT_FALSE(camera::photograph_together(in_colours(40), cameras, {}, {}));
}

}  // namespace
}  // namespace hogel::camera
