// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "hogel/core/test_targets.h"
#include "hogel/stereogram/hogel_synthesis.h"
#include "hogel/stereogram/windows/overlap_add.h"

namespace hogel::stereogram::windows {
namespace {

HOGEL_TEST_ON_EVERY_TARGET(OverlapAddHologram);

using Complex = std::complex<float>;

// A light field with dark rays, rays to points on either side of the plane, and rays without a surface.
LightFieldBuffer noise(std::size_t hogels_s, std::size_t hogels_t, std::size_t directions_u, std::size_t directions_v,
                       double pitch) {
    LightFieldBuffer field(
        {hogels_s, hogels_t, pitch, directions_u, directions_v, Perspective{0.035, 0.03, 0.004, 0}, 3}, true);
    std::mt19937 random(1);
    for (float& radiance : field.radiance.elements())
        radiance = random() % 5 == 0 ? 0.0f : static_cast<float>(random() % 1000) / 1000;
    for (float& depth : field.depth.elements())
        depth = random() % 7 == 0 ? std::numeric_limits<float>::infinity()
                                  : (static_cast<float>(random() % 2000) - 1000) * 3e-6f;
    return field;
}

HologramOptions options_of(PointPhases phases, double pitch) {
    HologramOptions options;
    options.channel = {520e-9, 1};
    options.pitch = pitch;
    options.method = OverlapAdd{phases};
    options.looks = 2;
    return options;
}

TEST_P(OverlapAddHologram, batches_of_windows_equal_windows_one_by_one) {
    for (const std::size_t hop : {1, 2, 3})
        for (const PointPhases phases : {PointPhases::fixed, PointPhases::random}) {
            const LightFieldBuffer rays = noise(37, 21, 9, 6, static_cast<double>(hop) * 6e-6);
            const HologramOptions options = options_of(phases, 6e-6);
            const LightField::Source source = borrow(rays).faces().front();
            const FieldGrid grid = hologram_grid({&rays.grid(), 1}, options);
            const Region all{0, 0, grid.plane.width, grid.plane.height};
            Array<Complex, 2> plain({all.height, all.width}), fast = plain;
            make_overlap_add(source, grid, options, phases, true)->read(all, 1, plain);
            make_overlap_add(source, grid, options, phases)->read(all, 1, fast);
            double signal = 0, error = 0;
            for (std::size_t i = 0; i < plain.size(); ++i) {
                signal += std::norm(plain.data()[i]);
                error += std::norm(plain.data()[i] - fast.data()[i]);
            }
            EXPECT_GT(signal, 0);
            EXPECT_LT(std::sqrt(error / signal), 1e-3) << hop;  // the plain version takes phases from a table of 67 dB
        }
}

TEST_P(OverlapAddHologram, a_sample_is_the_same_whatever_the_region) {
    const LightFieldBuffer rays = noise(70, 9, 9, 6, 12e-6);
    const auto hologram = make_hologram(borrow(rays), options_of(PointPhases::random, 6e-6));
    const Region all{0, 0, 140, 18};
    Array<Complex, 2> whole({all.height, all.width});
    hologram->read(all, 0, whole);
    for (const Region& part : {Region{0, 0, 1, 1}, {33, 5, 40, 7}, {97, 17, 43, 1}, {139, 0, 1, 18}}) {
        Array<Complex, 2> some({part.height, part.width}, Complex(7));
        hologram->read(part, 0, some);
        for (std::size_t y = 0; y < part.height; ++y)
            EXPECT_TRUE(
                std::ranges::equal(some[y].elements(), whole[part.y0 + y].elements().subspan(part.x0, part.width)))
                << part.x0 << " " << y;
    }
}

// A smooth surface has the power of its rays, mean |F|² = L Δs_x Δs_y, for any wavelength, number of views, depth,
// slope and hogel side, if neighbouring views meet within the window: white surfaces stay white.
TEST(SmoothSurfaces, have_the_power_of_their_rays_in_every_wavelength) {
    struct Case {
        std::size_t hogels, hop, views;
        double half, pitch;
    };
    constexpr double radiance = 0.7;
    for (const auto& [hogels, hop, views, half, pitch] : {Case{48, 1, 1, 0.0044, 8e-6},
                                                          {48, 1, 3, 0.028, 8e-6},
                                                          {48, 1, 5, 0.028, 8e-6},
                                                          {48, 1, 9, 0.028, 8e-6},
                                                          {48, 3, 9, 0.035, 5e-6},
                                                          {30, 8, 9, 0.035, 5e-6},
                                                          {12, 32, 32, 0.14, 1.5625e-6}})
        for (const double depth : {0.3e-3, -0.5e-3})
            for (const double slope : {0.0, 0.2}) {
                const double hogel = static_cast<double>(hop) * pitch;
                LightFieldBuffer card({hogels, hogels, hogel, views, views, Perspective{half, half}, 1}, true);
                std::ranges::fill(card.radiance.elements(), static_cast<float>(radiance));
                for (std::size_t ray = 0; ray < card.depth.size(); ++ray) {
                    const auto s = static_cast<double>(ray / (views * views) % hogels);
                    const double x = (s - static_cast<double>(hogels) / 2) * hogel, U = card.grid().u(ray % views);
                    card.depth.data()[ray] = static_cast<float>((depth + slope * x) / (1 - slope * U));
                }
                for (const double wavelength : {460e-9, 532e-9, 633e-9}) {
                    HologramOptions options = options_of(PointPhases::fixed, pitch);
                    options.channel = {wavelength, 0};
                    const auto hologram = make_hologram(borrow(card), options);
                    const std::size_t first = hogels / 3 * hop, side = hogels / 3 * hop;
                    Array<Complex, 2> middle({side, side});
                    hologram->read({first, first, side, side}, 0, middle);
                    double power = 0;
                    for (const Complex& sample : middle.elements()) power += std::norm(sample);
                    power /= static_cast<double>(middle.size());
                    const double sine = half / std::sqrt(1 + half * half);
                    // The waves of a wide fan are spherical, but factors are products of one for each axis.
                    EXPECT_NEAR(power / (radiance * 4 * sine * sine), 1, half > 0.1 ? 0.07 : 0.03)
                        << views << " views, " << hop << " samples, depth " << depth << ", slope " << slope << ", "
                        << wavelength;
                }
            }
}

}  // namespace
}  // namespace hogel::stereogram::windows
