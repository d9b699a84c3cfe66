// SPDX-License-Identifier: Apache-2.0
// Tests that every method shows surfaces of one radiance at the brightness of their rays, at any slope.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <ostream>
#include <random>
#include <string>

#include "hogel/hologram.h"
#include "hogel/photograph.h"
#include "hogel/stereogram/test_light_fields.h"
#include "hogel/units.h"

namespace hogel::stereogram {
namespace {

using namespace literals;

constexpr float shown = 0.7f;

// The plane ζ = depth + slope_x x + slope_y y, with an error of its depth.
struct Plane {
    double depth = 0, slope_x = 0, slope_y = 0, error = 0;
};

LightFieldBuffer light_field_of(const LightFieldGrid& grid, const Plane& plane) {
    LightFieldBuffer light_field(grid, true);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> error(-plane.error, plane.error);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t l = 0; l < grid.directions_v; ++l)
                for (std::size_t k = 0; k < grid.directions_u; ++k) {
                    const double at_hogel =
                        plane.depth + plane.slope_x * grid.s(double(s)) + plane.slope_y * grid.t(double(t));
                    const double along = plane.slope_x * grid.u(double(k)) + plane.slope_y * grid.v(double(l));
                    light_field.depth(t, s, l, k) =
                        float(at_hogel / (1 - along) + (plane.error > 0 ? error(random) : 0));
                    light_field.radiance(0, t, s, l, k) = shown;
                }
    return light_field;
}

struct Shown {
    std::string name;
    HologramMethod method;
    LightFieldGrid grid;
    double pitch, far, wavelength = 633_nm;  // the largest depth for this width of hologram
};
void PrintTo(const Shown& named, std::ostream* out) { *out << named.name; }

const LightFieldGrid stereogram{20, 20, 50_um, 26, 26, Perspective{0.1, 0.1}, 1},
    near_eye{160, 160, 6.4_um, 9, 9, Perspective{0.0406, 0.0406}, 1},
    two_samples{110, 110, 8_um, 11, 11, Perspective{0.06, 0.06}, 1},
    wide{90, 90, 3_um, 17, 17, Perspective{0.28, 0.28}, 1};

class TiltedSurface : public testing::TestWithParam<Shown> {
  protected:
    // Tolerance beside speckle, which is stronger for bright cells than for an even surface.
    const double tolerance = std::holds_alternative<PhaseAdded>(GetParam().method) ? 0.08 : 0.05;

    // The mean of a photograph of the middle, focused on the plane.
    double photographed(const Plane& plane) const {
        const auto& [name, method, grid, pitch, far, wavelength] = GetParam();
        HologramOptions options;
        options.channel.wavelength = wavelength;
        options.method = method;
        options.pitch = pitch;
        options.looks = 3;
        const LightFieldBuffer light_field = light_field_of(grid, plane);
        Camera camera;
        const double size = double(grid.hogels_s) * grid.pitch;
        camera.eye = {0, 0, 50_mm};
        camera.pupil = 0.8 * 50_mm * grid.half_u();
        camera.focus_depth = plane.depth;
        camera.picture = {12, 12, 0.4 * size / 12, 0.4 * size / 12, 0, 0};
        return mean_of(photograph(*make_hologram(borrow(light_field), options), std::span(&camera, 1))[0]);
    }
};

// Every slope at one or two of three depths: each photograph takes a large part of a second.
TEST_P(TiltedSurface, is_as_bright_as_its_rays) {
    const std::array depths{0.1 * GetParam().far, -0.35 * GetParam().far, GetParam().far};
    const std::array slopes{0.0, 0.05, 0.1, 0.3, 1.0, 1.5};
    for (std::size_t i = 0; i < depths.size(); ++i)
        for (std::size_t j = i % 2; j < slopes.size(); j += 2)
            for (const bool across : {true, false}) {
                const double depth = depths[i], slope = slopes[j];
                if (slope == 0 && !across) continue;
                // Either axis alone on one side, and both axes on the other.
                const Plane plane = depth > 0 ? Plane{depth, across ? slope : 0, across ? 0 : -slope}
                                              : Plane{depth, 0.6 * slope, (across ? 0.8 : -0.8) * slope};
                EXPECT_NEAR(photographed(plane) / shown, 1, tolerance)
                    << depth << " " << plane.slope_x << " " << plane.slope_y;
            }
}

// With depths as after compression.
TEST_P(TiltedSurface, is_as_bright_with_inexact_depth) {
    for (const double slope : {0.0, 0.3})
        for (const double error : {0.2e-6, 4e-6})
            EXPECT_NEAR(photographed({-0.35 * GetParam().far, slope, 0, error}) / shown, 1, tolerance)
                << slope << " " << error;
}

INSTANTIATE_TEST_SUITE_P(Methods, TiltedSurface,
                         testing::Values(Shown{"fourier", Fourier{}, stereogram, 2_um, 2_mm},
                                         Shown{"basis", Basis{}, stereogram, 2_um, 2_mm},
                                         Shown{"phase-added", PhaseAdded{}, stereogram, 2_um, 2_mm},
                                         Shown{"phase-added-exact", PhaseAdded{true}, stereogram, 2_um, 2_mm},
                                         Shown{"olas, near an eye", OverlapAdd{}, near_eye, 6.4_um, 2_mm, 520_nm},
                                         Shown{"olas, two samples a hogel", OverlapAdd{}, two_samples, 4_um, 2_mm},
                                         Shown{"olas, wide", OverlapAdd{}, wide, 1_um, 0.25_mm}),
                         [](const auto& each) {
                             std::string name;
                             for (const char c : each.param.name)
                                 if (std::isalnum(static_cast<unsigned char>(c))) name += c;
                             return name;
                         });

}  // namespace
}  // namespace hogel::stereogram
