// SPDX-License-Identifier: Apache-2.0
// The camera's speed on a field of noise in memory.
//   camera_bench [samples across=6144] [threads=1] [rounds=3]
// Printed: how fast the narrow band takes a hologram in; what a new focus then takes at 1024 x 1024 pixels, from a film
// of about as many samples; and how long a field of 2048 x 2048 samples takes to another plane, against the bare
// transforms of the same size there and back; and what the full camera takes for a photograph of 4096 x 4096 samples,
// against the bare transforms that it needs. The best of some rounds: wall time, and in brackets processor time.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <random>

#include "hogel/core/parallel.h"
#include "hogel/math/fft.h"
#include "hogel/optics/capture.h"
#include "hogel/optics/spectrum.h"
#include "hogel/units.h"

namespace {

using namespace hogel;
using namespace hogel::literals;

Field noise(std::size_t across) {
    Field field({{across, across, 1.5625_um, 1.5625_um, 0, 0}, 633_nm});
    std::minstd_rand random(1);
    for (auto& value : field.samples.elements())
        value = {static_cast<float>(random() % 2048) - 1024, static_cast<float>(random() % 2048) - 1024};
    return field;
}

struct Seconds {
    double wall = 1e30, processor = 1e30;
};

Seconds best_of(std::size_t rounds, const std::function<void()>& work) {
    Seconds best;
    for (std::size_t i = 0; i < rounds; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const std::clock_t processor = std::clock();
        work();
        best.processor = std::min(best.processor, double(std::clock() - processor) / CLOCKS_PER_SEC);
        best.wall =
            std::min(best.wall, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
}

void narrow_band(std::size_t across, std::size_t rounds) {
    const Field field = noise(across);
    const optics::narrow_band::NarrowBand band(field.grid(), {0, 0, 300_mm}, 6_mm);
    const Seconds seconds = best_of(rounds, [&] { optics::narrow_band::draw_narrow_bands(field, {&band, 1}, 0, 1); });
    const double samples = double(field.grid().plane.samples()) * 1e-6;
    std::printf("narrow band: %.0f Msamples/s, %.0f a second of processor time, one sample of %zu x %zu kept\n",
                samples / seconds.wall, samples / seconds.processor, band.factor, band.factor);
}

void new_focus(std::size_t rounds) {
    const Field field = noise(4608);  // 7.2 mm, 228 resolution cells
    Camera camera;
    camera.pupil = 6_mm;
    camera.focus_depth = 6_mm;
    camera.picture = {1024, 1024, field.grid().plane.size_x() / 1024, field.grid().plane.size_y() / 1024, 0, 0};
    const auto eyes = optics::capture(field, {&camera, 1});
    const Seconds first = best_of(3 * rounds, [&] { eyes.front().photograph(camera); });
    camera.pupil = 4_mm;
    camera.focus_depth = -5_mm;
    const Seconds second = best_of(3 * rounds, [&] { eyes.front().photograph(camera); });
    std::printf("new focus: %.1f ms (%.1f), new pupil and focus: %.1f ms (%.1f) at 1024 x 1024 pixels\n",
                1e3 * first.wall, 1e3 * first.processor, 1e3 * second.wall, 1e3 * second.processor);
}

void plane_to_plane(std::size_t rounds) {
    const Field field = noise(2048);
    const Seconds whole = best_of(rounds, [&] { optics::propagate(field, 5_mm); });
    Array<std::complex<float>, 2> window({5120, 5120});
    const math::Fft2 fft(5120, 5120);
    const Seconds bare = best_of(rounds, [&] {
        fft.forward(window);
        fft.backward(window);
    });
    std::printf("2048 x 2048 samples to another plane: %.2f s (%.2f), transforms of 5120 x 5120: %.2f s (%.2f)\n",
                whole.wall, whole.processor, bare.wall, bare.processor);
}

// The transforms of a full photograph: the hologram's rows in its window and the band's columns; from them to the lens,
// from its opening to plane waves, and from these to the plane in focus.
void full_camera(std::size_t rounds) {
    const Field field = noise(4096);
    const Grid& plane = field.grid().plane;
    const double wavelength = field.grid().wavelength, room = 1.1;
    Camera camera;
    camera.pupil = 6_mm;
    camera.focus_depth = -3_mm;
    camera.picture = {400, 400, plane.size_x() / 400, plane.size_y() / 400, 0, 0};
    const Seconds whole = best_of(rounds, [&] { photograph_fully(field, {&camera, 1}); });

    const double pupil = room * camera.pupil;
    const Grid window = optics::padded(plane, plane.size_x() + pupil, plane.size_y() + pupil);
    const optics::Band band =
        optics::band_between(Rectangle(plane), Rectangle(Grid{1, 1, pupil, pupil, 0, 0}), camera.eye.z, wavelength);
    const auto columns = std::size_t((band.high_x - band.low_x) * window.size_x());
    const double film = std::max(room * double(columns), 3 * pupil / (wavelength * camera.eye.z) * window.size_x());
    const std::size_t side = math::good_fft_size(std::size_t(film) + 16);
    Array<std::complex<float>, 1> line({std::max(window.width, side)});
    const auto lines = [&](std::size_t samples, std::size_t count) {
        const math::Fft1 fft(samples);
        for (std::size_t i = 0; i < count; ++i) {
            std::ranges::fill(line.elements(), std::complex<float>(1));
            fft.forward(line.data());
        }
    };
    const Seconds bare = best_of(rounds, [&] {
        lines(window.width, plane.height + columns);
        lines(side, 2 * (columns + side) + 2 * side);
    });
    std::printf("full photograph of 4096 x 4096 samples: %.2f s (%.2f), its transforms alone: %.2f s (%.2f)\n",
                whole.wall, whole.processor, bare.wall, bare.processor);
}

}  // namespace

int main(int argc, char** argv) {
    const auto number = [&](int i, std::size_t otherwise) {
        return argc > i ? std::strtoul(argv[i], nullptr, 10) : otherwise;
    };
    const hogel::ThreadLimit limit(number(2, 1));
    const std::size_t rounds = number(3, 3);
    narrow_band(number(1, 6144), rounds);
    new_focus(rounds);
    plane_to_plane(rounds);
    full_camera(rounds);
}
