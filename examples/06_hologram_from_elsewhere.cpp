// SPDX-License-Identifier: Apache-2.0
// Opens a field of another program, here a zone plate in a NumPy file, and photographs it.
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "hogel/hogel.h"

using namespace hogel;
using namespace hogel::literals;

int main() {
    // Stands in for the other program: writes a spherical wave that converges 20 mm in front of its plane.
    constexpr std::size_t n = 1024;
    constexpr double pitch = 4e-6, wavelength = 532e-9, distance = 20e-3;
    Array<std::complex<float>, 2> samples({n, n});
    for (std::size_t row = 0; row < n; ++row)
        for (std::size_t column = 0; column < n; ++column) {
            const double x = (double(column) + 0.5 - n / 2.0) * pitch, y = (double(row) + 0.5 - n / 2.0) * pitch;
            const double r = std::sqrt(x * x + y * y + distance * distance);
            samples(row, column) = std::polar(1.0f, float(std::remainder(-r / wavelength, 1.0) * 2 * std::numbers::pi));
        }
    write_npy("zone_plate.npy", samples);

    ExternalField field;  // a NumPy file does not contain the sampling
    field.pitch_x = field.pitch_y = pitch;
    field.wavelength = wavelength;
    const auto hologram = open_external_field("zone_plate.npy", field);
    Camera camera = camera_for(n * pitch, n * pitch, 256);
    camera.focus_depth = -distance;  // in front of the plane
    camera.pupil = 2_mm;
    const Image picture = photograph(*hologram, camera);
    write_image("point.png", picture, automatic_exposure(picture));
    std::printf("in the middle %.3g, at the edge %.3g\n", double(picture.pixels(128, 128, 0)),
                double(picture.pixels(128, 8, 0)));
}
