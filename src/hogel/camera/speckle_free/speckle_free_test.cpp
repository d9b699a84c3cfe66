// SPDX-License-Identifier: Apache-2.0
// The mean of infinitely many looks (camera/speckle_free) against means of looks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/photograph.h"
#include "hogel/stereogram/test_light_fields.h"
#include "hogel/units.h"

namespace hogel::camera::speckle_free {
namespace {

using namespace literals;
using namespace stereogram;

// Stripes on a tilted plane, so that neighbouring hogels and directions differ.
double stripes(Vec3 hogel, Vec3 direction) {
    const double depth = -0.4e-3;
    const double x = hogel.x + depth * direction.x / direction.z, y = hogel.y + depth * direction.y / direction.z;
    return 0.6 + 0.4 * std::sin(2 * std::numbers::pi * (x / 290e-6 + y / 440e-6));
}

struct Case {
    std::string name;
    LightFieldGrid grid;
    double pitch;
    Camera camera;
};

Camera camera_at(Vec3 eye, double pupil, double focus, std::size_t pixels, double width, double x = 0) {
    Camera camera;
    camera.eye = eye;
    camera.pupil = pupil;
    camera.focus_depth = focus;
    camera.picture = {pixels, pixels, width / double(pixels), width / double(pixels), x, 0};
    return camera;
}

std::vector<Case> cases() {
    const LightFieldGrid grid{72, 68, 48_um, 24, 24, Perspective{0.15, 0.15}, 1};
    const LightFieldGrid small{100, 100, 24_um, 24, 24, Perspective{0.15, 0.15}, 1};
    const LightFieldGrid odd{50, 50, 40.5_um, 24, 24, Perspective{0.15, 0.15}, 1};
    return {
        {"on the hologram", grid, 1.5_um, camera_at({0, 0, 30_mm}, 0.7_mm, 0, 72, 72 * 48_um)},
        {"behind it, oblique", grid, 1.5_um, camera_at({3_mm, -2_mm, 30_mm}, 0.7_mm, 3_mm, 57, 72 * 48_um)},
        {"in front of it, a part, pixels smaller than hogels", grid, 1.5_um,
         camera_at({-2_mm, 1_mm, 30_mm}, 0.5_mm, -2_mm, 96, 48 * 48_um, 0.2_mm)},
        {"small hogels, large pixels", small, 1.5_um, camera_at({1_mm, 1_mm, 30_mm}, 0.6_mm, 0, 50, 100 * 24_um)},
        {"odd hogels, wide pupil", odd, 1.5_um, camera_at({-2_mm, 1_mm, 30_mm}, 1.4_mm, 1_mm, 50, 50 * 40.5_um)},
    };
}

Image photo(const LightField& light_field, const Case& c, std::size_t looks) {
    const auto hologram =
        make_hologram(light_field, {{532_nm, 0}, c.pitch, Fourier{}, std::max<std::size_t>(looks, 1), 7});
    const CameraModel model = looks == 0 ? CameraModel(SpeckleFreeCamera()) : BandCamera();
    return photograph(*hologram, {&c.camera, 1}, model).front();
}

double mean(const Image& image) {
    double sum = 0;
    for (const float value : image.pixels.elements()) sum += value;
    return sum / double(image.pixels.size());
}

double distance(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        sum += std::pow(double(a.pixels.data()[i]) - double(b.pixels.data()[i]), 2);
    return std::sqrt(sum / double(a.pixels.size()));
}

TEST(ExpectedPhotograph, is_what_means_of_looks_converge_to) {
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        const LightField light_field = light_field_of_faces({&c.grid, 1}, stripes);
        const Image expected = photo(light_field, c, 0);
        const Image many = photo(light_field, c, 64);
        EXPECT_NEAR(mean(many) / mean(expected), 1, 0.004);
        const double four = distance(photo(light_field, c, 4), expected),
                     sixteen = distance(photo(light_field, c, 16), expected), sixty_four = distance(many, expected);
        EXPECT_NEAR(2 * sixteen / four, 1, 0.05);
        EXPECT_NEAR(4 * sixty_four / four, 1, 0.05);
    }
}

// Returns the share of a picture's light beside the outline of a hologram.
double share_beside(const Image& image, const Grid& picture, const Grid& hologram) {
    const Rectangle outline(hologram);
    double beside = 0;
    for (std::size_t row = 0; row < picture.height; ++row)
        for (std::size_t column = 0; column < picture.width; ++column)
            if (!outline.holds(picture.x(double(column)), picture.y(double(row))))
                beside += image.pixels(row, column, 0);
    return beside / (mean(image) * double(image.pixels.size()));
}

struct Outline {
    std::string name;
    double focus;
    Radiance radiance;
    double allowed;
};

class Surroundings : public ::testing::TestWithParam<Outline> {};

// All cameras show, beside the outline, the blur of a hologram out of focus and points that float in front of its edge,
// as rays do.
TEST_P(Surroundings, are_lit_alike_by_rays_and_by_waves) {
    const LightFieldGrid grid{24, 22, 48_um, 24, 24, Perspective{0.15, 0.15}, 1};
    const LightField light_field = light_field_of_faces({&grid, 1}, GetParam().radiance);
    const auto hologram = make_hologram(light_field, {{532_nm, 0}, 1.5_um, Fourier{}, 8, 7});
    Camera camera = camera_at({0.1_mm, 0, 30_mm}, 1.5_mm, GetParam().focus, 50, 1.6_mm, 0.05_mm);
    const Image rays = photograph(light_field, {&camera, 1}).front();
    const double beside = share_beside(rays, camera.picture, hologram->grid().plane);
    EXPECT_GT(beside, 0.04);
    const auto check = [&](const Image& picture, const char* name) {
        EXPECT_NEAR(share_beside(picture, camera.picture, hologram->grid().plane), beside, GetParam().allowed) << name;
        EXPECT_NEAR(mean(picture) / mean(rays), 1, 0.05) << name;
    };
    check(photograph(*hologram, {&camera, 1}, BandCamera{.source = BandSource::hogel_spectra}).front(), "eye");
    check(photograph(*hologram, {&camera, 1}, BandCamera{.source = BandSource::hogel_spectra, .preview = true}).front(),
          "preview");
    check(photograph(*hologram, {&camera, 1}, BandCamera{.source = BandSource::samples}).front(), "narrow");
    check(photograph(*hologram, {&camera, 1}, PlaneWaveCamera()).front(), "full");
    check(photograph(*hologram, {&camera, 1}, SpeckleFreeCamera()).front(), "infinitely many looks");
}

double card_before_the_edge(Vec3 hogel, Vec3 direction) {
    const double depth = -4e-3;
    const double x = hogel.x + depth * direction.x / direction.z, y = hogel.y + depth * direction.y / direction.z;
    return std::abs(x - 0.5_mm) < 0.06_mm && std::abs(y) < 0.3_mm ? 1 : 0;
}

INSTANTIATE_TEST_SUITE_P(FieldsAndFocuses, Surroundings,
                         ::testing::Values(Outline{"uniform_behind", 4_mm, [](Vec3, Vec3) { return 0.3; }, 0.006},
                                           Outline{"uniform_before", -4_mm, [](Vec3, Vec3) { return 0.3; }, 0.006},
                                           Outline{"card", -4_mm, card_before_the_edge, 0.05}),
                         [](const auto& outline) { return outline.param.name; });

// Bands of rows of hogels and one viewpoint at a time give the same pictures.
TEST(ExpectedPhotograph, fits_into_little_memory) {
    const Case c = cases().front();
    const LightField light_field = light_field_of_faces({&c.grid, 1}, stripes);
    const auto hologram = make_hologram(light_field, {{532_nm, 0}, c.pitch, Fourier{}, 1, 7});
    Camera other = c.camera;
    other.eye.x += 1_mm;
    other.focus_depth = 2_mm;
    const std::vector<Camera> cameras{c.camera, other};
    SpeckleFreeCamera model;
    const std::vector<Image> whole = photograph(*hologram, cameras, model);
    model.memory = 500'000;
    const std::vector<Image> bands = photograph(*hologram, cameras, model);
    for (std::size_t i = 0; i < cameras.size(); ++i) EXPECT_LT(distance(whole[i], bands[i]), 1e-5 * mean(whole[i]));
}

// Progress comes in small steps, because callers estimate the remaining time from it.
TEST(ExpectedPhotograph, says_in_small_steps_how_far_it_is) {
    const Case c = cases().front();
    const LightField light_field = light_field_of_faces({&c.grid, 1}, stripes);
    const auto hologram = make_hologram(light_field, {{532_nm, 0}, c.pitch, Fourier{}, 1, 7});
    SpeckleFreeCamera model;
    for (const std::size_t memory : {std::size_t{1} << 30, std::size_t{500'000}}) {
        model.memory = memory;
        std::vector<double> fractions{0};
        photograph(*hologram, {&c.camera, 1}, model, [&](double fraction) {
            fractions.push_back(fraction);
            return true;
        });
        EXPECT_EQ(fractions.back(), 1);
        for (std::size_t i = 1; i < fractions.size(); ++i) {
            EXPECT_GE(fractions[i], fractions[i - 1]);
            EXPECT_LT(fractions[i], fractions[i - 1] + 0.08);
        }
    }
}

TEST(ExpectedPhotograph, needs_independent_random_phases) {
    const Case c = cases().front();
    const LightField light_field = light_field_of_faces({&c.grid, 1}, stripes);
    SpeckleFreeCamera model;
    const auto hologram = make_hologram(light_field, {{532_nm, 0}, c.pitch, Fourier{Phases::fixed}, 1, 7});
    EXPECT_THROW(photograph(*hologram, {&c.camera, 1}, model), Error);
}

}  // namespace
}  // namespace hogel::camera::speckle_free
