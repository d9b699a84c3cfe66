// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "hogel/camera/hogel_spectra/hogel_band_source.h"
#include "hogel/core/random.h"
#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/photograph.h"
#include "hogel/resources.h"
#include "hogel/stereogram/test_light_fields.h"
#include "hogel/units.h"

namespace hogel::camera::hogel_spectra {
namespace {

using namespace literals;
using namespace stereogram;
using Wide = std::complex<double>;

// Stripes across a tilted plane, so that neighbouring hogels and directions differ.
double stripes(Vec3 hogel, Vec3 direction) {
    const double depth = -0.4e-3;
    const double x = hogel.x + depth * direction.x / direction.z, y = hogel.y + depth * direction.y / direction.z;
    return 0.6 + 0.4 * std::sin(2 * std::numbers::pi * (x / 90e-6 + y / 140e-6));
}

// The same with the depth of every ray.
LightField striped_with_depth(const LightFieldGrid& grid) {
    const LightFieldBuffer stripes_alone = light_field_of(grid, stripes);
    auto light_field = std::make_shared<LightFieldBuffer>(grid, true);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t l = 0; l < grid.directions_v; ++l)
                for (std::size_t k = 0; k < grid.directions_u; ++k) {
                    light_field->radiance(0, t, s, l, k) = stripes_alone.radiance(0, t, s, l, k);
                    light_field->depth(t, s, l, k) = -0.4e-3f;
                }
    return LightField(LightField::Source(std::move(light_field)));
}

LightField striped(const LightFieldGrid& grid) { return light_field_of_faces({&grid, 1}, stripes); }

std::unique_ptr<PupilBandSource> draw_hogels_of(const FieldSource& hologram, const Region& part,
                                                std::span<const Viewpoint> eyes) {
    return make_hogel_band_source(*hologram.stereogram(), part, eyes);
}

// Light of samples on a grid at points of the pupil, up to a common factor: point q of the pupil, in units of the
// frequency that it has after demodulation.
Wide light_of(const auto& sample, const Grid& plane, const auto& cycles, double qx, double qy) {
    Wide sum = 0;
    for (std::size_t row = 0; row < plane.height; ++row)
        for (std::size_t column = 0; column < plane.width; ++column) {
            const double x = plane.x(double(column)), y = plane.y(double(row));
            sum += Wide(sample(row, column)) * optics::unit_phasor(cycles(x, y) - qx * x - qy * y);
        }
    return sum * plane.pitch_x * plane.pitch_y;
}

// From the whole field.
Wide light_at(View<const std::complex<float>, 2> field, const Grid& plane, const camera::ViewGeometry& geometry,
              double qx, double qy) {
    return light_of(
        field, plane, [&](double x, double y) { return geometry.cycles(x, y); }, qx, qy);
}

// From a pupil band, which is demodulated.
Wide light_at(const camera::PackedBand& band, const Grid& plane, double qx, double qy) {
    const auto sample = [&](std::size_t row, std::size_t column) { return math::unpacked(*band.at(row, column)); };
    return light_of(
        sample, plane, [](double, double) { return 0.0; }, qx, qy);
}

struct Case {
    std::string name;
    LightField light_field;
    HologramMethod method;
    double pitch;
    Viewpoint eye;
};

LightFieldGrid grid_of(std::size_t hogels, double pitch) {
    return {hogels, hogels - 2, pitch, 24, 24, Perspective{0.15, 0.15}, 1};
}

std::vector<Case> cases() {
    const LightField plain = striped(grid_of(8, 48_um));
    const LightField row = striped({8, 6, 48_um, 24, 1, Perspective{0.15, 0.01}, 1});
    const auto hemicube = hemicube_of({5, 4, 24_um, 12, 12, Perspective{1, 1}, 1}, stripes);
    return {
        {"in the middle", plain, Fourier{}, 1.5_um, {{0, 0, 30_mm}, 1_mm}},
        {"oblique", plain, Fourier{}, 1.5_um, {{4_mm, -3_mm, 30_mm}, 1.4_mm}},
        {"far from both axes", plain, Fourier{}, 1.5_um, {{9_mm, -8_mm, 30_mm}, 1_mm}},
        {"near", plain, Fourier{}, 1.5_um, {{0.4_mm, 0.7_mm, 6_mm}, 0.3_mm}},
        {"phases shared by hogels", plain, Fourier{Phases::fixed}, 1.5_um, {{1_mm, 2_mm, 30_mm}, 1_mm}},
        {"designed phases", plain, Fourier{Phases::designed}, 1.5_um, {{1_mm, 2_mm, 30_mm}, 1_mm}},
        {"averages of amplitudes",
         plain,
         Fourier{Phases::random, LobeAverage::amplitude},
         1.5_um,
         {{1_mm, 2_mm, 30_mm}, 1_mm}},
        {"hogels that are no power of two", striped(grid_of(7, 45_um)), Fourier{}, 1.5_um, {{2_mm, 1_mm, 30_mm}, 1_mm}},
        {"odd hogels", striped(grid_of(7, 40.5_um)), Fourier{}, 1.5_um, {{-2_mm, 1_mm, 30_mm}, 1_mm}},
        {"phases of points",
         striped_with_depth({8, 6, 48_um, 32, 32, Perspective{0.15, 0.15}, 1}),
         PhaseAdded{},
         1.5_um,
         {{1_mm, 2_mm, 30_mm}, 1_mm}},
        {"hemicube", hemicube, Fourier{}, 0.5_um, {{12_mm, 5_mm, 25_mm}, 0.9_mm}},
        {"basis fringes", plain, Basis{}, 1.5_um, {{1_mm, 2_mm, 30_mm}, 1_mm}},
        {"the largest basis fringes", plain, Basis{"haar", 0.1}, 1.5_um, {{1_mm, 2_mm, 30_mm}, 1_mm}},
        {"constant pieces of designed phases",
         plain,
         Basis{"pieces", 0, SharedPhases::designed},
         1.5_um,
         {{1_mm, 2_mm, 30_mm}, 1_mm}},
        {"basis fringes of a hemicube", hemicube, Basis{}, 0.5_um, {{12_mm, 5_mm, 25_mm}, 0.9_mm}},
        {"lines as far apart as samples", row, Lines{}, 1.5_um, {{1_mm, 2_mm, 30_mm}, 1_mm}},
        {"a few lines to a hogel", row, Lines{8_um}, 1.5_um, {{1_mm, 0.5_mm, 30_mm}, 0.5_mm}},
        {"lines that share phases", row, Lines{12_um, Phases::fixed}, 1.5_um, {{2_mm, -0.4_mm, 30_mm}, 0.3_mm}},
        {"lines of basis fringes",
         row,
         Basis{"cdf97", 0, SharedPhases::fixed, 6_um},
         1.5_um,
         {{2_mm, -0.4_mm, 30_mm}, 0.5_mm}},
        {"overlapping windows",
         striped_with_depth({8, 6, 48_um, 16, 16, Perspective{0.15, 0.15}, 1}),
         OverlapAdd{},
         1.5_um,
         {{1_mm, 2_mm, 30_mm}, 1_mm}},
        {"overlapping windows of odd hogels, without phases of points",
         striped_with_depth({9, 7, 25.5_um, 16, 16, Perspective{0.15, 0.15}, 1}),
         OverlapAdd{PointPhases::fixed},
         1.5_um,
         {{1_mm, 2_mm, 30_mm}, 1_mm}},
        {"a tiny pupil", plain, Fourier{}, 1.5_um, {{1_mm, 1_mm, 30_mm}, 50_um}},
    };
}

// The relative error of the light of two looks in the pupil, of each look.
std::vector<double> errors_in_pupil(const Case& c) {
    std::vector<double> errors;
    {
        HologramOptions options{{532_nm, 0}, c.pitch, c.method, 2, 7};
        const auto hologram = make_hologram(c.light_field, options);
        const Grid& plane = hologram->grid().plane;
        const Region all{0, 0, plane.width, plane.height};
        const auto drawing = draw_hogels_of(*hologram, all, {&c.eye, 1});
        if (!drawing) return {};
        const camera::narrow_band::BandGrid& band = drawing->band(0);
        const auto bands = drawing->synthesize(0, 2, {});
        for (std::size_t look : {0, 1}) {
            Array<std::complex<float>, 2> field({plane.height, plane.width});
            hologram->read(all, look, field);
            double wrong = 0, light = 0;
            for (double radius : {0.0, 0.5, 1.0})
                for (int turn = 0; turn < 8; ++turn) {
                    const double edge = 0.5 * c.eye.pupil / (532e-9 * std::hypot(c.eye.position.x, c.eye.position.z));
                    const double qx = radius * edge * std::cos(turn), qy = radius * edge * std::sin(turn);
                    const Wide truth = light_at(field, plane, band.geometry, qx, qy);
                    wrong += std::norm(light_at(bands[0][look], band.plane, qx, qy) - truth);
                    light += std::norm(truth);
                }
            errors.push_back(std::sqrt(wrong / light));
        }
    }
    return errors;
}

TEST(HogelBandSource, send_the_light_of_the_samples_into_the_pupil) {
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        const std::vector<double> errors = errors_in_pupil(c);
        ASSERT_EQ(errors.size(), 2u);
        for (const double error : errors) EXPECT_LT(error, 2e-3);
    }
}

TEST(HogelBandSource, send_most_of_the_light_in_a_preview) {
    double largest = 0;
    for (Case& c : cases()) {
        SCOPED_TRACE(c.name);
        c.eye.preview = true;
        const std::vector<double> errors = errors_in_pupil(c);
        ASSERT_EQ(errors.size(), 2u);
        for (const double error : errors) {
            EXPECT_LT(error, 0.3);
            largest = std::max(largest, error);
        }
    }
    EXPECT_GT(largest, 2e-3);  // something is left out
}

TEST(HogelBandSource, draw_a_window_as_a_part_of_the_whole) {
    const LightField light_field = striped(grid_of(8, 48_um));
    const auto hologram = make_hologram(light_field, {{532_nm, 0}, 1.5_um, Fourier{}, 1, 1});
    const Viewpoint eye{{1_mm, 2_mm, 30_mm}, 1_mm};
    const Region part{40, 33, 90, 70};  // cuts hogels 1 to 4 and 1 to 3
    const auto window = draw_hogels_of(*hologram, part, {&eye, 1});
    ASSERT_TRUE(window);
    const auto band = window->synthesize(0, 1, {});
    Array<std::complex<float>, 2> field({96, 128});
    hologram->read({32, 32, 128, 96}, 0, field);
    const Grid plane = hogel::part(hologram->grid().plane, {32, 32, 128, 96});
    const Wide truth = light_at(field, plane, window->band(0).geometry, 1e4, -2e4);
    const Wide drawn = light_at(band[0][0], window->band(0).plane, 1e4, -2e4);
    EXPECT_LT(std::abs(drawn - truth), 2e-3 * std::abs(truth));
}

TEST(HogelBandSource, do_not_depend_on_threads_or_on_other_eyes) {
    const LightField light_field = striped(grid_of(40, 48_um));
    const auto hologram = make_hologram(light_field, {{532_nm, 0}, 1.5_um, Fourier{}, 3, 1});
    const std::vector<Viewpoint> eyes{{{1_mm, 2_mm, 30_mm}, 1_mm}, {{-3_mm, 0, 40_mm}, 0.5_mm}};
    const Region all{0, 0, hologram->grid().plane.width, hologram->grid().plane.height};
    const auto synthesize = [&](std::span<const Viewpoint> some, std::size_t first, std::size_t looks) {
        return draw_hogels_of(*hologram, all, some)->synthesize(first, looks, {});
    };
    const auto both = synthesize(eyes, 0, 3);
    const ThreadLimit single(1);
    const auto one = synthesize({&eyes[1], 1}, 1, 2);
    for (std::size_t look : {0, 1}) EXPECT_TRUE(both[1][look + 1] == one[0][look]);
}

// Many looks are interleaved in vectors; few looks share vectors with other hogels.
TEST(HogelBandSource, do_not_depend_on_other_looks) {
    const LightField light_field = striped(grid_of(40, 48_um));
    const auto hologram = make_hologram(light_field, {{532_nm, 0}, 1.5_um, Fourier{}, 18, 1});
    const Viewpoint eye{{1_mm, 2_mm, 30_mm}, 1_mm};
    const Region all{0, 0, hologram->grid().plane.width, hologram->grid().plane.height};
    const auto drawing = draw_hogels_of(*hologram, all, {&eye, 1});
    const auto together = drawing->synthesize(0, 18, {}), some = drawing->synthesize(2, 8, {});
    for (std::size_t look : {0, 2, 9, 15, 16, 17}) {
        const auto alone = drawing->synthesize(look, 1, {});
        EXPECT_TRUE(together[0][look] == alone[0][0]) << look;
        if (look >= 2 && look < 10) {
            EXPECT_TRUE(some[0][look - 2] == alone[0][0]) << look;
        }
    }
}

Camera camera(double pupil) {
    Camera camera;
    camera.eye = {2_mm, -1_mm, 30_mm};
    camera.pupil = pupil;
    camera.picture = {64, 64, 30_um, 30_um, 0, 0};
    return camera;
}

TEST(HogelBandSource, give_the_photograph_of_the_samples) {
    const LightField light_field = striped(grid_of(40, 48_um));
    const auto hologram = make_hologram(light_field, {{532_nm, 0}, 1.5_um, Fourier{}, 4, 1});
    std::vector<Camera> cameras(2, camera(1_mm));
    cameras[1].focus_depth = -1_mm;
    const auto seen = photograph(*hologram, cameras, BandCamera{.source = BandSource::hogel_spectra});
    const auto truth = photograph(*hologram, cameras, BandCamera{.source = BandSource::samples});
    const auto cheaper = photograph(*hologram, cameras);
    for (std::size_t i : {0, 1}) {
        double wrong = 0, light = 0;
        for (std::size_t p = 0; p < truth[i].pixels.size(); ++p) {
            const double difference = double(seen[i].pixels.data()[p]) - double(truth[i].pixels.data()[p]);
            wrong += difference * difference;
            light += double(truth[i].pixels.data()[p]) * double(truth[i].pixels.data()[p]);
        }
        EXPECT_LT(std::sqrt(wrong / light), 0.01);
        EXPECT_NEAR(mean_of(seen[i]) / mean_of(truth[i]), 1, 2e-3);
        EXPECT_TRUE(std::ranges::equal(cheaper[i].pixels.elements(), seen[i].pixels.elements()));
    }
}

TEST(HogelBandSource, are_refused_where_there_are_none) {
    const LightField light_field = striped(grid_of(8, 48_um));
    const auto exact = make_hologram(striped_with_depth({8, 6, 48_um, 32, 32, Perspective{0.15, 0.15}, 1}),
                                     {{532_nm, 0}, 1.5_um, PhaseAdded{true}, 1, 1});
    const Camera one = camera(1_mm);
    EXPECT_THROW(photograph(*exact, {&one, 1}, BandCamera{.source = BandSource::hogel_spectra}), Error);
    EXPECT_NO_THROW(photograph(*exact, {&one, 1}));
    // A pupil that takes in more than half of a hogel's waves.
    const auto hologram = make_hologram(light_field, {{532_nm, 0}, 1.5_um, Fourier{}, 1, 1});
    const Camera wide = camera(4.5_mm);
    EXPECT_THROW(photograph(*hologram, {&wide, 1}, BandCamera{.source = BandSource::hogel_spectra}), Error);
    EXPECT_NO_THROW(photograph(*hologram, {&wide, 1}));
}

}  // namespace
}  // namespace hogel::camera::hogel_spectra
