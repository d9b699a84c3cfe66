// SPDX-License-Identifier: Apache-2.0
// How fast plain stereograms are made, beside the bare Fourier transforms that they cannot do without.
//   stereogram_bench [samples across=4096] [rounds=5]
// A Markdown row for each size of hogel, one thread, million samples per second of processor time: the stereogram with
// random phases, from a light field of noise in memory to a field in memory; the transforms of as many squares of the
// same size, one after the other over a whole hologram, in place. The light field's directions fill what the pitch
// diffracts to. The best of some rounds, which take turns.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <random>

#include "hogel/core/parallel.h"
#include "hogel/hologram.h"
#include "hogel/math/fft.h"

namespace {

using namespace hogel;

double seconds(const std::function<void()>& work) {
    const std::clock_t start = std::clock();
    work();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

void measure(std::size_t side, std::size_t directions, std::size_t across, int rounds) {
    const std::size_t hogels = across / side;
    HologramOptions options;
    options.pitch = 2e-6;
    const double tangent = 0.98 * std::tan(std::asin(options.wavelength / (2 * options.pitch)));
    LightFieldBuffer rays(
        {hogels, hogels, double(side) * options.pitch, directions, directions, Perspective{tangent, tangent}, 1});
    std::minstd_rand random(1);
    for (float& ray : rays.radiance.elements()) ray = float(random() % 1024) / 1024;
    const auto stereogram = make_hologram(rays, options);
    Field field(stereogram->grid());
    Array<std::complex<float>, 3> squares({hogels * hogels, side, side});
    for (auto& value : squares.elements()) value = {float(random() % 1024) - 512, float(random() % 1024) - 512};
    const math::Fft2 fft(side, side);
    double whole = 1e30, bare = 1e30;
    for (int i = 0; i < rounds; ++i) {
        whole = std::min(whole, seconds([&] { copy(*stereogram, field); }));
        bare = std::min(bare, seconds([&] {
                            for (std::size_t k = 0; k < hogels * hogels; ++k) fft.backward(squares[k]);
                        }));
    }
    const double samples = 1e-6 * double(squares.size());
    std::printf("| %zu × %zu, %zu × %zu | %.0f | %.0f | %.2f |\n", side, side, directions, directions, samples / whole,
                samples / bare, whole / bare);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t across = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 4096;
    const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
    const ThreadLimit one(1);
    std::printf("| samples, directions a hogel | stereogram | bare transforms | ratio |\n|---|---|---|---|\n");
    for (const auto& [side, directions] :
         {std::pair<std::size_t, std::size_t>{32, 32}, {64, 64}, {128, 128}, {256, 128}, {256, 256}})
        measure(side, directions, across, rounds);
}
