// SPDX-License-Identifier: Apache-2.0
// From a scene to a photograph: an eye in front of the hologram sees the picture of geometric optics.
#include <gtest/gtest.h>

#include <cmath>

#include "hogel/hologram.h"
#include "hogel/image.h"
#include "hogel/photograph.h"
#include "hogel/renderer.h"
#include "hogel/scene.h"
#include "hogel/shading.h"
#include "hogel/units.h"

namespace hogel {
namespace {

using namespace literals;

constexpr std::size_t pixels = 256;
constexpr double size = 12.8_mm;

// Photographs of the jack-o'-lantern in green light, from the left and from the upper right, focused on the hologram
// plane and behind it: by waves, averaged over 16 sets of phases, and by rays.
struct Photographs {
    std::vector<Camera> cameras;
    std::vector<Image> waves, rays;

    Photographs() {
        const LightFieldGrid grid{pixels, pixels, size / pixels, 32, 32, Perspective{0.15, 0.15}, 3};
        LightFieldBuffer light_field(grid);
        const auto scene = std::make_shared<const ShadedScene>(shade_scene_vertices(make_scene("pumpkin", size)));
        copy(*make_renderer("raytrace", scene, grid), light_field);
        for (const Vec3 eye : {Vec3{-25_mm, 0, 300_mm}, Vec3{20_mm, 15_mm, 300_mm}})
            for (double focus : {0_mm, 2.5_mm}) {
                Camera camera;
                camera.eye = eye;
                camera.focus_depth = focus;
                camera.pupil = 5_mm;
                camera.picture = {pixels, pixels, size / pixels, size / pixels, 0, 0};
                cameras.push_back(camera);
            }
        HologramOptions options;
        options.channel = {532_nm, 1};
        options.pitch = size / pixels / 32;
        options.looks = 16;
        waves = photograph(*make_hologram(borrow(light_field), options), cameras);
        for (const Image& colour : photograph(borrow(light_field), cameras)) {
            Image green(pixels, pixels, 1);
            for (std::size_t i = 0; i < green.pixels.size(); ++i)
                green.pixels.data()[i] = colour.pixels.data()[3 * i + 1];
            rays.push_back(std::move(green));
        }
    }
};

class PumpkinPhotograph : public ::testing::Test {
  protected:
    static const Photographs& photographs() {
        static const Photographs taken;
        return taken;
    }
    static double exposure() { return automatic_exposure(photographs().rays[0]); }
};

TEST_F(PumpkinPhotograph, differs_from_geometric_optics_by_little_more_than_speckle) {
    for (std::size_t i = 0; i < photographs().cameras.size(); ++i) {
        const ImageComparison comparison = compare(photographs().waves[i], photographs().rays[i], exposure());
        EXPECT_GT(comparison.psnr, 33) << i;  // the figure of the README
        RecordProperty("psnr_" + std::to_string(i), std::to_string(comparison.psnr));
        RecordProperty("ssim_" + std::to_string(i), std::to_string(comparison.ssim));
    }
}

double block_mean(const Image& image, std::size_t row, std::size_t column, std::size_t side) {
    double sum = 0;
    for (std::size_t y = row; y < row + side; ++y)
        for (std::size_t x = column; x < column + side; ++x) sum += image.pixels(y, x, 0);
    return sum / static_cast<double>(side * side);
}

// Radiance is kept without a fitted factor.
TEST_F(PumpkinPhotograph, is_as_bright_as_geometric_optics_says_everywhere) {
    for (std::size_t i = 0; i < photographs().cameras.size(); ++i) {
        const Image &wave = photographs().waves[i], &ray = photographs().rays[i];
        EXPECT_NEAR(block_mean(wave, 0, 0, pixels) / block_mean(ray, 0, 0, pixels), 1, 0.02) << i;
        for (std::size_t row = 0; row < pixels; row += 32)
            for (std::size_t column = 0; column < pixels; column += 32) {
                const double expected = block_mean(ray, row, column, 32);
                EXPECT_NEAR(block_mean(wave, row, column, 32), expected, 0.05 * expected + 0.01 / exposure()) << i;
            }
    }
}

// The mask of the picture against the dark background: where it is brighter than a twentieth of display white after
// smoothing over 5 pixels.
std::vector<bool> silhouette(const Image& image, double exposure) {
    std::vector<bool> inside;
    for (std::size_t row = 0; row + 5 <= pixels; ++row)
        for (std::size_t column = 0; column + 5 <= pixels; ++column)
            inside.push_back(block_mean(image, row, column, 5) * exposure > 0.05);
    return inside;
}

TEST_F(PumpkinPhotograph, has_the_silhouette_that_geometric_optics_says) {
    for (std::size_t i = 0; i < photographs().cameras.size(); ++i) {
        const auto wave = silhouette(photographs().waves[i], exposure()),
                   ray = silhouette(photographs().rays[i], exposure());
        std::size_t both = 0, either = 0;
        for (std::size_t k = 0; k < wave.size(); ++k) {
            both += wave[k] && ray[k];
            either += wave[k] || ray[k];
        }
        EXPECT_GT(either, wave.size() / 5);
        EXPECT_GT(static_cast<double>(both), 0.96 * static_cast<double>(either)) << i;
    }
}

// The number of rows of a picture that are compared together, so many that speckle shifts them by less than half a
// pixel.
constexpr std::size_t strip = 36;

// The horizontal shift, in pixels, of a strip of one picture that best fits another one.
double shift_between(const Image& from, const Image& to, std::size_t row) {
    const auto correlation = [&](int shift) {
        double ab = 0, aa = 0, bb = 0;
        for (std::size_t y = row; y < row + strip; ++y)
            for (int x = 40; x < static_cast<int>(pixels) - 40; ++x) {
                const double a = from.pixels(y, static_cast<std::size_t>(x), 0),
                             b = to.pixels(y, static_cast<std::size_t>(x + shift), 0);
                ab += a * b;
                aa += a * a;
                bb += b * b;
            }
        return ab / std::sqrt(aa * bb);
    };
    int best = -30;
    for (int shift = -30; shift <= 30; ++shift)
        if (correlation(shift) > correlation(best)) best = shift;
    const double before = correlation(best - 1), at = correlation(best), after = correlation(best + 1);
    return best + 0.5 * (before - after) / (before - 2 * at + after);
}

// Between two eyes the parts of the pumpkin shift against the frame of the hologram according to their depth. The
// shifts by waves and by rays agree to a fraction of a pixel.
TEST_F(PumpkinPhotograph, has_the_parallax_that_geometric_optics_says) {
    for (std::size_t row = 60; row + 60 < pixels; row += strip) {
        const double by_waves = shift_between(photographs().waves[0], photographs().waves[2], row);
        const double by_rays = shift_between(photographs().rays[0], photographs().rays[2], row);
        EXPECT_NEAR(by_waves, by_rays, 0.5) << row;
    }
}

}  // namespace
}  // namespace hogel
