// SPDX-License-Identifier: Apache-2.0
// Holograms of light fields whose directions are frequencies of a hogel.
#include <gtest/gtest.h>

#include <cmath>

#include "hogel/hologram.h"
#include "hogel/photograph.h"
#include "hogel/stereogram/frequency_grid.h"
#include "hogel/stereogram/test_light_fields.h"
#include "hogel/units.h"

namespace hogel::stereogram {
namespace {

using namespace literals;

// The same smooth light sampled in the directions of a hogel's transform and in perspective.
TEST(FrequencyGridLightField, is_not_resampled_and_agrees_with_one_in_perspective) {
    const double wavelength = 532_nm, pitch = 64_um, step = wavelength / pitch;
    LightFieldGrid sines{2, 2, pitch, 31, 27, Perspective{15.5 * step, 13.5 * step}, 1};
    sines.view = Frequencies{sines.range()};
    ASSERT_TRUE(is_frequency_grid(sines, wavelength));
    EXPECT_FALSE(is_frequency_grid(sines, 633_nm));
    const auto light = [](Vec3 hogel, Vec3 direction) {
        return 1 + 0.3 * std::sin(9 * direction.x / direction.z) * std::cos(7 * direction.y / direction.z) +
               2000 * hogel.x;
    };
    const LightFieldBuffer exact = light_field_of(sines, light);
    const FrequencyGrid frequencies(sines, 64, wavelength);
    std::vector<float> moduli(std::size_t{64} * 64);
    frequencies.amplitudes({&exact.radiance(0, 1, 1, 0, 0), sines.directions()}, moduli);
    const LightFieldGrid tangents{2, 2, pitch, 301, 301, Perspective{0.15, 0.15}, 1};
    const LightFieldBuffer seen = light_field_of(tangents, light);
    std::vector<float> interpolated(std::size_t{64} * 64);
    FrequencyGrid(tangents, 64, wavelength)
        .amplitudes({&seen.radiance(0, 1, 1, 0, 0), tangents.directions()}, interpolated);
    for (int j = -13; j <= 13; ++j)
        for (int i = -15; i <= 15; ++i) {
            const std::size_t at = std::size_t((64 - j) % 64) * 64 + std::size_t((64 + i) % 64);
            const double cosine = std::sqrt(1 - (i * i + j * j) * step * step);
            // The ray of frequency (i, j)/d has the opposite sign: column 15 − i; rows are counted downwards.
            const int l = 13 + j, k = 15 - i;
            const double L = exact.radiance(0, 1, 1, std::size_t(l), std::size_t(k));
            EXPECT_NEAR(moduli[at], step * std::sqrt(L / cosine), 1e-6 * step) << i << " " << j;
            EXPECT_NEAR(interpolated[at] / moduli[at], 1, 1e-3) << i << " " << j;
        }
}

TEST(FrequencyGridLightField, has_the_same_photograph_by_waves_and_by_rays) {
    const double wavelength = 633_nm, pitch = 50_um, step = wavelength / pitch;
    LightFieldGrid sines{24, 24, pitch, 17, 17, Perspective{8.5 * step, 8.5 * step}, 1};
    sines.view = Frequencies{sines.range()};
    const LightFieldBuffer light = light_field_of(sines, [](Vec3 hogel, Vec3 direction) {
        return hogel.x + 2_mm * direction.x / direction.z > 0.1_mm ? 1.0 : 0.2;  // an edge behind the hologram
    });
    HologramOptions options;
    options.pitch = 2_um;
    options.looks = 4;
    const auto hologram = make_hologram(borrow(light), options);
    Camera camera;
    camera.eye = {3_mm, 0, 80_mm};
    camera.pupil = 3_mm;
    camera.focus_depth = 2_mm;
    camera.picture = {8, 1, 120_um, 900_um, 0, 0};
    const Image waves = photograph(*hologram, std::span(&camera, 1))[0];
    const Image rays = photograph(borrow(light), std::span(&camera, 1))[0];
    for (std::size_t x = 0; x < 8; ++x) EXPECT_NEAR(waves.pixels.data()[x], rays.pixels.data()[x], 0.1) << x;
}

}  // namespace
}  // namespace hogel::stereogram
