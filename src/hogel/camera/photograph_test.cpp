// SPDX-License-Identifier: Apache-2.0
#include "hogel/photograph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <random>

#include "hogel/camera/photograph_plan.h"
#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::camera {
namespace {

using namespace literals;

// The exact spherical wave of a point at (x, y, z), converging if the point is in front of the plane.
Field spherical_wave(const FieldGrid& grid, Vec3 point) {
    Field field(grid);
    const double k = 2 * std::numbers::pi / grid.wavelength;
    for (std::size_t row = 0; row < grid.plane.height; ++row)
        for (std::size_t column = 0; column < grid.plane.width; ++column) {
            const double r = length(Vec3{grid.plane.x(double(column)), grid.plane.y(double(row)), 0} - point);
            field.samples(row, column) = std::complex<float>(std::polar(0.01 / r, k * (point.z < 0 ? r : -r)));
        }
    return field;
}

// Independent samples; their real and imaginary parts have this standard deviation.
Field random_field(const FieldGrid& grid, unsigned seed, float deviation = 1) {
    Field field(grid);
    std::mt19937 random(seed);
    std::normal_distribution<float> normal(0, deviation);
    for (auto& value : field.samples.elements()) value = {normal(random), normal(random)};
    return field;
}

double sum(const Image& image) {
    double total = 0;
    for (float value : image.pixels.elements()) total += value;
    return total;
}

double correlation(const Image& a, const Image& b) {
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        ab += double(a.pixels.data()[i]) * b.pixels.data()[i];
        aa += double(a.pixels.data()[i]) * a.pixels.data()[i];
        bb += double(b.pixels.data()[i]) * b.pixels.data()[i];
    }
    return ab / std::sqrt(aa * bb);
}

struct Case {
    Vec3 point, eye;
    double focus, slope_x = 0, slope_y = 0;
};

class NarrowBandCamera : public ::testing::TestWithParam<Case> {};

// The narrow-band camera gives the same picture, in the same units, as the sum over every sample and every point of the
// pupil.
TEST_P(NarrowBandCamera, agrees_with_direct_summation) {
    const Case& c = GetParam();
    const FieldGrid grid{{128, 128, 4_um, 4_um, 0, 0}, 633_nm};
    const Field field = spherical_wave(grid, c.point);
    Camera camera;
    camera.eye = c.eye;
    camera.focus_depth = c.focus;
    camera.focus_slope_x = c.slope_x;
    camera.focus_slope_y = c.slope_y;
    camera.pupil = 3_mm;
    camera.picture = {26, 26, 20_um, 20_um, 0, 0};
    const Image fast = photograph(field, std::span(&camera, 1))[0];
    const Image direct = photograph(field, {&camera, 1}, DirectCamera{64, 3}).front();
    // Where the plane in focus is tilted, the film blends pictures of neighbouring defocuses.
    EXPECT_GT(correlation(fast, direct), 0.99998);
    EXPECT_NEAR(sum(fast) / sum(direct), 1, 3e-3);
}

INSTANTIATE_TEST_SUITE_P(PointsEyesAndFocuses, NarrowBandCamera,
                         ::testing::Values(Case{{0, 0, -4e-3}, {0, 0, 0.1}, 0},
                                           Case{{0.1e-3, -0.12e-3, -4e-3}, {0, 0, 0.1}, 4e-3},
                                           Case{{-0.02e-3, 0.03e-3, 3e-3}, {4e-3, -2e-3, 0.1}, -3e-3},
                                           Case{{0.12e-3, -0.05e-3, -3e-3}, {-6e-3, 5e-3, 0.1}, 1e-3},
                                           Case{{0.1e-3, 0.05e-3, -3e-3}, {2e-3, 0, 0.1}, 1e-3, 20, -10}));

// A point is sharp where a tilted plane in focus passes through it, and blurred elsewhere.
TEST(Photograph, a_tilted_film_is_in_focus_along_its_own_plane) {
    const FieldGrid grid{{500, 500, 2_um, 2_um, 0, 0}, 633_nm};
    const Field field = spherical_wave(grid, {0.2_mm, 0, -5_mm});
    const auto peak = [&](double slope) {
        Camera camera;
        camera.eye = {0, 0, 60_mm};
        camera.pupil = 3_mm;
        camera.focus_slope_x = slope;
        camera.picture = {100, 20, 10_um, 10_um, 0, 0};
        const Image picture = photograph(field, std::span(&camera, 1))[0];
        return *std::ranges::max_element(picture.pixels.elements());
    };
    EXPECT_GT(peak(25), 8 * peak(0));
    EXPECT_GT(peak(0), 2 * peak(-25));
}

// A field of independent random samples is a diffuse surface, which has the same radiance from all directions and with
// any pupil. With complex samples of variance σ² at pitch Δ its spectrum is σ²Δ² per unit of frequency, which is
// Lλ²/cos θ.
TEST(Photograph, a_diffuse_field_has_its_radiance_from_everywhere) {
    const FieldGrid grid{{1500, 1500, 1_um, 1_um, 0, 0}, 633_nm};
    const Field field = random_field(grid, 5, std::sqrt(0.5f));
    const double at_zero = 1e-12 / (633e-9 * 633e-9);  // radiance at cos θ = 1
    for (const Vec3 eye : {Vec3{0, 0, 0.1}, Vec3{0.024, 0, 0.1}, Vec3{0, -0.01, 0.06}})
        for (double pupil : {4_mm, 8_mm}) {
            Camera camera;
            camera.eye = eye;
            camera.pupil = pupil;
            camera.picture = {20, 20, 60_um, 60_um, 0, 0};
            const double mean = sum(photograph(field, std::span(&camera, 1))[0]) / 400;
            const double expected = at_zero * eye.z / length(eye);
            EXPECT_NEAR(mean / expected, 1, 0.06) << eye.x << " " << eye.y << " " << pupil;
        }
}

TEST(Photograph, averages_looks) {
    const FieldGrid grid{{300, 200, 5_um, 5_um, 0, 0}, 532_nm};
    const Field field = spherical_wave(grid, {0, 0, -5e-3});
    // Two looks that are the same field: their average is each of them.
    class Twice final : public FieldSource {
      public:
        explicit Twice(const Field& f) : field(f) {}
        const FieldGrid& grid() const override { return field.grid(); }
        std::size_t looks() const override { return 2; }
        void read(const Region& region, std::size_t, View<std::complex<float>, 2> out) const override {
            field.read(region, 0, out);
        }
        const Field& field;
    };
    Camera camera;
    camera.eye.z = 0.15;
    camera.picture = {30, 20, 50_um, 50_um, 0, 0};
    const Image once = photograph(field, std::span(&camera, 1))[0];
    const Image twice = photograph(Twice(field), std::span(&camera, 1))[0];
    for (std::size_t i = 0; i < once.pixels.size(); ++i)
        EXPECT_NEAR(once.pixels.data()[i], twice.pixels.data()[i], 1e-5f * (1 + once.pixels.data()[i]));
}

// The plane-wave camera gives the same picture as the narrow-band camera, down to the speckle, on the axis and at 20°.
TEST(PhotographByPlaneWaves, equals_the_narrow_band_camera) {
    const FieldGrid grid{{1300, 1200, 0.8_um, 0.8_um, 0.1_mm, -0.1_mm}, 633_nm};
    const Field field = random_field(grid, 8);
    std::vector<Camera> cameras;
    for (const Vec3 eye : {Vec3{0, 0, 100_mm}, Vec3{36.4_mm, -8_mm, 100_mm}})
        for (const double focus : {0.0, 4e-3, -3e-3}) {
            Camera& camera = cameras.emplace_back();
            camera.eye = eye;
            camera.pupil = 4_mm;
            camera.focus_depth = focus;
            camera.picture = {52, 48, 20_um, 20_um, 0.1_mm, -0.1_mm};
        }
    const auto narrow = photograph(field, cameras), full = photograph(field, cameras, PlaneWaveCamera());
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        // Off the axis it would be 0.9994 without the distortion of the pupil's disc in the plane of frequencies.
        EXPECT_GT(correlation(narrow[c], full[c]), 0.99997) << c;
        EXPECT_NEAR(sum(narrow[c]) / sum(full[c]), 1, 2e-3) << c;
    }
}

// The squares of the waves in focus are the picture of the plane-wave camera, and the wave from a point has the phase
// of the light's path, one cycle per wavelength, wherever the point is.
TEST(WavesInFocus, have_the_phases_of_their_paths) {
    Camera camera;
    camera.eye = {6_mm, -3_mm, 60_mm};
    camera.pupil = 3_mm;
    camera.focus_depth = 1_mm;
    camera.picture = {31, 31, 4_um, 4_um, 0, 0};
    // The wave from the point in focus at the picture's middle, or from a farther point on the line of sight.
    const auto through = [&](double farther) {
        const Vec3 point = (61.0 / 60 + farther / length(camera.eye)) * (Vec3{} - camera.eye) + camera.eye;
        const Field field = spherical_wave({{600, 600, 0.8_um, 0.8_um, 0, 0}, 633_nm}, point);
        return waves_in_focus(field, 0, std::span(&camera, 1))[0];
    };
    const auto here = through(0), quarter = through(0.25 * 633_nm);
    EXPECT_NEAR(std::arg(quarter(15, 15) / here(15, 15)), std::numbers::pi / 2, 0.05);
    // In focus, a PSF has a constant phase up to the first dark ring.
    const double cell = resolution_cell(camera, 633_nm);
    for (std::size_t row = 0; row < 31; ++row)
        for (std::size_t column = 0; column < 31; ++column) {
            const double x = camera.picture.x(double(column)), y = camera.picture.y(double(row));
            if (std::hypot(x, y) > 0.6 * cell) continue;
            EXPECT_LT(std::abs(std::arg(here(row, column) / here(15, 15))), 0.2) << row << ' ' << column;
        }
    PlaneWaveCamera film;
    film.film_distance = 10_mm;
    Field any({{64, 64, 0.8_um, 0.8_um, 0, 0}, 633_nm});
    EXPECT_THROW(waves_in_focus(any, 0, std::span(&camera, 1), film), Error);
}

// The plane-wave camera tilts the plane in focus by rotating plane waves, the narrow-band camera by a phase of the
// pupil that depends on the direction. Both must agree.
TEST(PhotographByPlaneWaves, equals_the_narrow_band_camera_on_a_tilted_plane) {
    const FieldGrid grid{{700, 640, 0.8_um, 0.8_um, 0.1_mm, -0.1_mm}, 633_nm};
    const Field field = random_field(grid, 9);
    for (const Vec3 eye : {Vec3{0, 0, 50_mm}, Vec3{12_mm, -4_mm, 50_mm}}) {
        Camera camera;
        camera.eye = eye;
        camera.pupil = 3_mm;
        camera.focus_depth = 0.3_mm;
        camera.focus_slope_x = 1.5;
        camera.focus_slope_y = -0.8;
        camera.picture = {40, 36, 14_um, 14_um, 0.1_mm, -0.1_mm};
        const Image narrow = photograph(field, std::span(&camera, 1))[0],
                    full = photograph(field, std::span(&camera, 1), PlaneWaveCamera())[0];
        EXPECT_GT(correlation(narrow, full), 0.9998) << eye.x;
        EXPECT_NEAR(sum(narrow) / sum(full), 1, 4e-3) << eye.x;
        camera.focus_slope_y = 0.8;
        EXPECT_LT(correlation(photograph(field, std::span(&camera, 1), PlaneWaveCamera())[0], full), 0.99) << eye.x;
    }
}

// A thin lens with a film behind it gives the picture of a perfect lens, at any distance of the film, if the pupil is
// so narrow that a parabola approximates a sphere; through a wide pupil the picture differs.
TEST(PhotographByPlaneWaves, a_thin_lens_is_perfect_for_a_narrow_pupil) {
    const FieldGrid grid{{280, 250, 1.5_um, 1.5_um, 50_um, 0}, 633_nm};
    const Field field = random_field(grid, 10);
    const auto alike = [&](double pupil, double focus, double film_distance) {
        Camera camera;
        camera.eye = {0.2_mm, -0.1_mm, 10_mm};
        camera.pupil = pupil;
        camera.focus_depth = focus;
        camera.picture = {40, 36, 10_um, 10_um, 50_um, 0};
        const Image perfect = photograph(field, std::span(&camera, 1), PlaneWaveCamera())[0];
        const Image thin = photograph(field, std::span(&camera, 1), PlaneWaveCamera{{}, film_distance})[0];
        // Some light of a blurred point falls outside the film.
        EXPECT_NEAR(sum(thin) / sum(perfect), 1, pupil < 1_mm ? 1e-2 : 3e-2) << pupil << " " << film_distance;
        return correlation(perfect, thin);
    };
    EXPECT_GT(alike(0.3_mm, 0, 4_mm), 0.998);
    EXPECT_GT(alike(0.3_mm, 0.6_mm, 10_mm), 0.998);
    EXPECT_GT(alike(0.3_mm, -0.6_mm, 16_mm), 0.998);
    EXPECT_LT(alike(2.4_mm, 0, 10_mm), 0.98);
}

// With little memory a hologram is photographed window by window and one camera at a time. The picture is the same
// except for light that falls far from its point.
TEST(Photograph, window_by_window_is_the_same_picture) {
    const FieldGrid grid{{8000, 150, 1_um, 1_um, 0.5_mm, 0}, 633_nm};
    const Field field = random_field(grid, 6);
    std::vector<Camera> cameras(3);
    for (Camera& camera : cameras) {
        camera.eye = {1_mm, 0, 30_mm};
        camera.pupil = 5_mm;
        camera.picture = {400, 8, 20_um, 20_um, 0.5_mm, 0};
    }
    cameras[1].focus_depth = cameras[2].focus_depth = 0.2_mm;
    cameras[2].picture = {420, 20, 20_um, 20_um, 0.5_mm, 0};
    const auto whole = photograph(field, cameras);
    const BandCamera little{.memory = std::size_t{40} << 20};
    const PhotographPlan plan = plan_photographs(grid, cameras, double(little.memory));
    EXPECT_LE(plan.bytes, double(little.memory));
    EXPECT_GT(plan.windows.size(), 1u);
    const auto parts = photograph(field, cameras, little);
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        EXPECT_GT(correlation(parts[c], whole[c]), 0.9998) << c;
        EXPECT_NEAR(sum(parts[c]) / sum(whole[c]), 1, 2e-3) << c;
    }
    // The last one shows what is beside the hologram, too.
    const auto beside = [](const Image& picture) {
        double light = 0;
        for (std::size_t row : {4, 5, 14, 15})
            for (std::size_t column = 0; column < picture.width(); ++column) light += picture.pixels(row, column, 0);
        return light;
    };
    EXPECT_GT(beside(whole[2]), 0.005 * sum(whole[2]));
    EXPECT_NEAR(beside(parts[2]) / beside(whole[2]), 1, 0.01);
}

// The surroundings of a hologram take memory where pictures show them, up to the limit of the light.
TEST(PhotographPlan, has_surroundings_only_where_pictures_show_them) {
    const FieldGrid grid{{1000, 800, 2_um, 2_um, 0.1_mm, 0}, 633_nm};
    const auto bytes = [&](double width, double middle, bool surroundings) {
        Camera camera;
        camera.eye = {1_mm, 0, 30_mm};
        camera.pupil = 2_mm;
        camera.focus_depth = 1_mm;
        camera.picture = {100, 80, width / 100, width / 100, middle, 0};
        const Rectangle active = illuminated_area(grid, camera.eye, camera.pupil, defocus_blur(camera)),
                        own(grid.plane), shown = film_area(grid.plane, Rectangle(camera.picture), active);
        const bool alone =
            shown.left == own.left && shown.right == own.right && shown.bottom == own.bottom && shown.top == own.top;
        EXPECT_EQ(alone, !surroundings) << width << " " << middle;
        return plan_photographs(grid, {&camera, 1}, 1e12).bytes;
    };
    const double alone = bytes(2_mm, 0.1_mm, false);
    EXPECT_EQ(bytes(1_mm, 0.1_mm, false), alone);
    EXPECT_EQ(bytes(1_mm, 90_mm, false), alone);
    EXPECT_GT(bytes(2_mm, 1.1_mm, true), alone);
    EXPECT_GT(bytes(3_mm, 0.1_mm, true), alone);
    EXPECT_EQ(bytes(60_mm, 0.1_mm, true), bytes(90_mm, 0.1_mm, true));
}

// For a wide lens and a large hologram, every plan stays within its memory.
TEST(PhotographPlan, keeps_within_the_memory_or_names_a_pupil_that_does) {
    const FieldGrid grid{{12800, 12800, 1.5625_um, 1.5625_um, 0, 0}, 460_nm};
    std::vector<Camera> cameras(6);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        cameras[i].eye = {double(i / 2) * 20_mm, 0, 1_m};
        cameras[i].pupil = 100_mm;
        cameras[i].focus_depth = (i % 2 == 0) ? -4e-3 : 8e-3;
        cameras[i].picture = {400, 400, 50_um, 50_um, 0, 0};
    }
    const PhotographPlan plan = plan_photographs(grid, cameras, 2e9);
    EXPECT_LE(plan.bytes, 2e9);
    EXPECT_GT(plan.windows.size() * plan.passes.size(), 1u);
    std::size_t planned = 0;
    for (const auto& pass : plan.passes) planned += pass.size();
    EXPECT_EQ(planned, cameras.size());
    try {
        plan_photographs(grid, cameras, 5e7);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find("would do"), std::string::npos) << error.what();
    }
}

TEST(RequireLightTowards, names_a_pitch_that_sends_light_to_the_eye) {
    const FieldGrid grid{{100, 100, 2_um, 2_um, 0, 0}, 633_nm};
    Camera camera;
    camera.eye = {0, 30_mm, 100_mm};
    camera.picture = {8, 8, 20_um, 20_um, 0, 0};
    try {
        photograph(Field(grid), std::span(&camera, 1), PlaneWaveCamera());
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        const std::string expected = "in y, but a pitch of 2 um sends light of 633 nm no farther than";
        EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
    EXPECT_THROW(require_light_towards(grid, camera), Error);
    camera.eye.y = 0;
    require_light_towards(grid, camera);
}

TEST(Photograph, names_a_pupil_that_would_do_where_one_is_too_wide_for_the_pitch) {
    const FieldGrid grid{{64, 64, 20_um, 20_um, 0, 0}, 633_nm};
    const Field field(grid);
    Camera camera;
    camera.eye.z = 0.1;
    camera.pupil = 10_mm;
    camera.picture = {8, 8, 100_um, 100_um, 0, 0};
    try {
        photograph(field, std::span(&camera, 1));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find("pupil of 1."), std::string::npos) << error.what();
    }
}

TEST(Photograph, of_a_pupil_that_resolves_nothing_is_refused_by_both_cameras) {
    Field hologram(FieldGrid{{64, 64, 10_um, 10_um, 0, 0}, 500_nm});
    for (auto& sample : hologram.samples.elements()) sample = 1;
    Camera camera;
    camera.eye = {0, 0, 0.3};
    camera.picture = {8, 8, 80_um, 80_um, 0, 0};
    // λR/A is the hologram's width for a pupil of 500 nm 0.3 m/0.64 mm = 0.234375 mm.
    const auto refusal = [&](double pupil, bool full) -> std::string {
        camera.pupil = pupil;
        try {
            if (full)
                photograph(hologram, {&camera, 1}, PlaneWaveCamera());
            else
                photograph(hologram, {&camera, 1});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            return error.what();
        }
        return "";
    };
    for (const double pupil : {1_nm, 1_um, 0.234_mm}) {
        EXPECT_NE(refusal(pupil, false).find("a pupil of 0.234375 mm would do"), std::string::npos) << pupil;
        EXPECT_NE(refusal(pupil, true).find("a pupil of 0.9375 mm would do"), std::string::npos) << pupil;
    }
    // The narrowest accepted pupil shows the picture of the direct sum, within 5 %.
    const auto expect_equal = [&](const Image& picture) {
        const Image direct = photograph(hologram, {&camera, 1}, DirectCamera{60, 2}).front();
        double error = 0, energy = 0;
        for (std::size_t i = 0; i < direct.pixels.size(); ++i) {
            error += std::pow(picture.pixels.data()[i] - direct.pixels.data()[i], 2);
            energy += std::pow(direct.pixels.data()[i], 2);
        }
        EXPECT_LT(std::sqrt(error / energy), 0.05);
    };
    camera.pupil = 0.24_mm;
    expect_equal(photograph(hologram, {&camera, 1})[0]);
    camera.pupil = 0.94_mm;
    expect_equal(photograph(hologram, {&camera, 1}, PlaneWaveCamera())[0]);
}

}  // namespace
}  // namespace hogel::camera
