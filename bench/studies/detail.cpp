// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "bench/session.h"
#include "bench/studies/studies.h"
#include "hogel/hologram.h"
#include "hogel/image.h"
#include "hogel/photograph.h"

namespace hogel::bench {
namespace {

constexpr double wavelength = 633e-9, pitch = 3e-6, eye = 100e-3;
constexpr std::size_t samples = 256, pixels = 32;

// Bright and dark spots of half a period.
double texture(double x, double y, double period) {
    const double turn = 2 * std::numbers::pi / period;
    return std::sin(turn * x) * std::sin(turn * y) > 0 ? 0.9 : 0.15;
}

// A plane with the texture; a ray has the mean over its share of the directions.
LightFieldBuffer light_field_of(const LightFieldGrid& grid, double depth, double period) {
    LightFieldBuffer light_field(grid, true);
    constexpr int fine = 3;
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t l = 0; l < grid.directions_v; ++l)
                for (std::size_t k = 0; k < grid.directions_u; ++k) {
                    double sum = 0;
                    for (int i = 0; i < fine * fine; ++i) {
                        const double column = double(k) + double(i % fine - 1) / fine,
                                     row = double(l) + double(i / fine - 1) / fine;
                        sum += texture(grid.s(double(s)) + grid.u(column) * depth,
                                       grid.t(double(t)) + grid.v(row) * depth, period);
                    }
                    light_field.depth(t, s, l, k) = float(depth);
                    light_field.radiance(0, t, s, l, k) = float(sum / (fine * fine));
                }
    return light_field;
}

// The exact photograph of the plane in focus: means of the texture over the pixels.
Image truth_of(const Camera& camera, double period) {
    const Grid& picture = camera.picture;
    const double stretch = (eye + camera.focus_depth) / eye;
    Image image(picture.width, picture.height, 1);
    constexpr int fine = 8;
    for (std::size_t row = 0; row < picture.height; ++row)
        for (std::size_t column = 0; column < picture.width; ++column) {
            double sum = 0;
            for (int i = 0; i < fine * fine; ++i)
                sum += texture(stretch * picture.x(double(column) + (i % fine + 0.5) / fine - 0.5),
                               stretch * picture.y(double(row) + (i / fine + 0.5) / fine - 0.5), period);
            image.pixels(row, column, 0) = float(sum / (fine * fine));
        }
    return image;
}

struct Shown {
    const char* name;
    HologramMethod method;
    std::size_t side, directions;  // samples of a hogel, and its directions, along one axis
};

}  // namespace

void study_detail(const DetailStudy& study) {
    const std::array all{Shown{"fourier", Fourier{}, 16, 64},
                         Shown{"fourier", Fourier{}, 32, 64},
                         Shown{"phase-added", PhaseAdded{}, 16, 64},
                         Shown{"phase-added-exact", PhaseAdded{true}, 16, 32},
                         Shown{"phase-added-exact", PhaseAdded{true}, 16, 64},
                         Shown{"olas", OverlapAdd{}, 4, 17},
                         Shown{"olas", OverlapAdd{}, 4, 33}};
    constexpr std::array depths{-10e-3, -5e-3, -2e-3, 0.0, 2e-3, 5e-3, 10e-3};
    std::printf("| method | samples a hogel | directions |");
    for (const double depth : depths) std::printf(" %g mm |", depth * 1e3);
    std::printf("\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (const Shown& shown : all) {
        std::printf("| `%s` | %zu | %zu |", shown.name, shown.side, shown.directions);
        for (const double depth : depths) {
            stop_if_interrupted();
            const std::size_t n = samples / shown.side;
            const LightFieldGrid grid{
                n, n, double(shown.side) * pitch, shown.directions, shown.directions, Perspective{0.1, 0.1}, 1};
            const LightFieldBuffer light_field = light_field_of(grid, depth, study.period);
            HologramOptions options;
            options.channel.wavelength = wavelength;
            options.pitch = pitch;
            options.method = shown.method;
            options.looks = study.looks;
            Camera camera;
            camera.eye = {0, 0, eye};
            camera.pupil = 4e-3;
            camera.focus_depth = depth;
            camera.picture = {pixels, pixels, 0.4e-3 / pixels, 0.4e-3 / pixels, 0, 0};
            const Image seen = photograph(*make_hologram(borrow(light_field), options), std::span(&camera, 1))[0];
            std::printf(" %.1f |", compare(truth_of(camera, study.period), seen).psnr);
            std::fflush(stdout);
        }
        std::printf("\n");
    }
}

}  // namespace hogel::bench
