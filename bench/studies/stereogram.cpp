// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <utility>

#include "bench/measure.h"
#include "bench/studies/studies.h"
#include "hogel/hologram.h"
#include "hogel/math/fft.h"
#include "hogel/resources.h"

namespace hogel::bench {
namespace {

// Prints a table row. The two measurements alternate in every round.
void measure(std::size_t side, std::size_t directions, std::size_t across, std::size_t rounds) {
    const std::size_t hogels = across / side;
    HologramOptions options;
    options.pitch = 2e-6;
    const double tangent = 0.98 * std::tan(std::asin(options.channel.wavelength / (2 * options.pitch)));
    LightFieldBuffer rays(
        {hogels, hogels, double(side) * options.pitch, directions, directions, Perspective{tangent, tangent}, 1});
    std::minstd_rand random(1);
    for (float& ray : rays.radiance.elements()) ray = float(random() % 1024) / 1024;
    const auto stereogram = make_hologram(borrow(rays), options);
    Field field(stereogram->grid());
    Array<std::complex<float>, 3> squares({hogels * hogels, side, side});
    for (auto& value : squares.elements()) value = {float(random() % 1024) - 512, float(random() % 1024) - 512};
    const math::Fft2 fft(side, side);
    double whole = 1e30, bare = 1e30;
    for (std::size_t i = 0; i < rounds; ++i) {
        whole = std::min(whole, time_of([&] { copy(*stereogram, field); }).processor);
        bare = std::min(bare, time_of([&] {
                                  for (std::size_t k = 0; k < hogels * hogels; ++k) fft.backward(squares[k]);
                              }).processor);
    }
    const double samples = 1e-6 * double(squares.size());
    std::printf("| %zu × %zu, %zu × %zu | %.0f | %.0f | %.2f |\n", side, side, directions, directions, samples / whole,
                samples / bare, whole / bare);
    std::fflush(stdout);
}

}  // namespace

void study_stereogram(const StereogramStudy& study) {
    const ThreadLimit one(1);
    std::printf("| samples, directions a hogel | stereogram | bare transforms | ratio |\n|---|---|---|---|\n");
    for (const auto& [side, directions] :
         {std::pair<std::size_t, std::size_t>{32, 32}, {64, 64}, {128, 128}, {256, 128}, {256, 256}})
        measure(side, directions, study.samples, study.rounds);
}

}  // namespace hogel::bench
