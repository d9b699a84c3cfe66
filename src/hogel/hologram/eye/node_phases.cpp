// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/eye/node_phases.h"

#include <cmath>
#include <complex>
#include <numbers>

#include "hogel/hologram/eye/project.h"
#include "hogel/optics/phase_walk.h"

namespace hogel::hologram::eye {

void node_phases_plain(const NodeLine& across, const NodeLine& down, double bend, std::span<const double> places,
                       float* phases) {
    const auto cycles = [](const NodeLine& line, double place) {
        const double along = line.first + line.step * place;
        return std::sqrt(along * along + line.square) * line.frequency - line.tilt * place - line.off;
    };
    const std::size_t row = phase_row(places.size());
    for (std::size_t y = 0; y < places.size(); ++y)
        for (std::size_t x = 0; x < places.size(); ++x) {
            const std::complex<float> phase(optics::unit_phasor(cycles(across, places[x]) + cycles(down, places[y]) +
                                                                bend * places[x] * places[y]));
            float* to = phases + 2 * y * row + 2 * x;
            to[0] = to[1] = phase.real();
            to[row] = -phase.imag();
            to[row + 1] = phase.imag();
        }
}

}  // namespace hogel::hologram::eye
