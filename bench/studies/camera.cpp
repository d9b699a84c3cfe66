// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <complex>
#include <cstdio>
#include <memory>
#include <random>

#include "bench/measure.h"
#include "bench/studies/studies.h"
#include "hogel/math/fft.h"
#include "hogel/optics/narrow_band/narrow_band.h"
#include "hogel/optics/spectrum.h"
#include "hogel/photograph.h"
#include "hogel/propagate.h"
#include "hogel/units.h"

namespace hogel::bench {
namespace {
using namespace hogel::literals;

Field noise(std::size_t across) {
    Field field({{across, across, 1.5625_um, 1.5625_um, 0, 0}, 633_nm});
    std::minstd_rand random(1);
    for (auto& value : field.samples.elements())
        value = {static_cast<float>(random() % 2048) - 1024, static_cast<float>(random() % 2048) - 1024};
    return field;
}

void narrow_band(std::size_t across, std::size_t rounds) {
    const Field field = noise(across);
    const optics::narrow_band::NarrowBand band(field.grid(), {0, 0, 300_mm}, 6_mm);
    const Times seconds = best_time_of(
        [&] {
            optics::narrow_band::draw_narrow_bands(field, {&band, 1}, 0, 1);
        },
        rounds);
    const double samples = double(field.grid().plane.samples()) * 1e-6;
    std::printf("narrow band: %.0f Msamples/s, %.0f a second of processor time, one sample of %zu x %zu kept\n",
                samples / seconds.wall, samples / seconds.processor, band.factor, band.factor);
}

void new_focus(std::size_t rounds) {
    const auto field = std::make_shared<const Field>(noise(4608));  // 7.2 mm, 228 resolution cells
    EyePhotographer photographer({field});
    Camera camera;
    camera.pupil = 6_mm;
    camera.focus_depth = 6_mm;
    camera.picture = {1024, 1024, field->grid().plane.size_x() / 1024, field->grid().plane.size_y() / 1024, 0, 0};
    photographer.photograph(camera);
    const Times first = best_time_of([&] { photographer.photograph(camera); }, 3 * rounds);
    camera.pupil = 4_mm;
    camera.focus_depth = -5_mm;
    const Times second = best_time_of([&] { photographer.photograph(camera); }, 3 * rounds);
    std::printf("new focus: %.1f ms (%.1f), new pupil and focus: %.1f ms (%.1f) at 1024 x 1024 pixels\n",
                1e3 * first.wall, 1e3 * first.processor, 1e3 * second.wall, 1e3 * second.processor);
}

void plane_to_plane(std::size_t rounds) {
    const Field field = noise(2048);
    const Times whole = best_time_of([&] { propagate(field, 5_mm); }, rounds);
    Array<std::complex<float>, 2> window({5120, 5120});
    const math::Fft2 fft(5120, 5120);
    const Times bare = best_time_of(
        [&] {
            fft.forward(window);
            fft.backward(window);
        },
        rounds);
    std::printf("2048 x 2048 samples to another plane: %.2f s (%.2f), transforms of 5120 x 5120: %.2f s (%.2f)\n",
                whole.wall, whole.processor, bare.wall, bare.processor);
}

// Measures a photograph by the full camera and its transforms alone: of the hologram's rows in its window and of the
// band's columns, from there to the lens, from its opening to plane waves, and from these to the plane in focus.
void full_camera(std::size_t rounds) {
    const Field field = noise(4096);
    const Grid& plane = field.grid().plane;
    const double wavelength = field.grid().wavelength, margin = 1.1;
    Camera camera;
    camera.pupil = 6_mm;
    camera.focus_depth = -3_mm;
    camera.picture = {400, 400, plane.size_x() / 400, plane.size_y() / 400, 0, 0};
    const Times whole = best_time_of([&] { photograph_by_plane_waves(field, {&camera, 1}); }, rounds);

    const double pupil = margin * camera.pupil;
    const Grid window = optics::padded(plane, plane.size_x() + pupil, plane.size_y() + pupil);
    const optics::Band band =
        optics::band_between(Rectangle(plane), Rectangle(Grid{1, 1, pupil, pupil, 0, 0}), camera.eye.z, wavelength);
    const auto columns = std::size_t((band.high_x - band.low_x) * window.size_x());
    const double film = std::max(margin * double(columns), 3 * pupil / (wavelength * camera.eye.z) * window.size_x());
    const std::size_t side = math::good_fft_size(std::size_t(film) + 16);
    Array<std::complex<float>, 1> line({std::max(window.width, side)});
    const auto lines = [&](std::size_t samples, std::size_t count) {
        const math::Fft1 fft(samples);
        for (std::size_t i = 0; i < count; ++i) {
            std::ranges::fill(line.elements(), std::complex<float>(1));
            fft.forward(line.data());
        }
    };
    const Times bare = best_time_of(
        [&] {
            lines(window.width, plane.height + columns);
            lines(side, 2 * (columns + side) + 2 * side);
        },
        rounds);
    std::printf("full photograph of 4096 x 4096 samples: %.2f s (%.2f), its transforms alone: %.2f s (%.2f)\n",
                whole.wall, whole.processor, bare.wall, bare.processor);
}

}  // namespace

void study_camera(const CameraStudy& study) {
    narrow_band(study.samples, study.rounds);
    new_focus(study.rounds);
    plane_to_plane(study.rounds);
    full_camera(study.rounds);
}

}  // namespace hogel::bench
