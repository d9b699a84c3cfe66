// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/demodulation.h"

#include <cmath>
#include <complex>

#include "hogel/optics/phase_walk.h"

namespace hogel::camera::hogel_spectra {

void demodulation_plain(const SampleLine& across, const SampleLine& down, double bend, std::size_t rows, float* phases,
                        std::size_t row) {
    const auto cycles = [](const SampleLine& line, double place) {
        const double along = line.first + line.step * place;
        return std::sqrt(along * along + line.square) * line.frequency - line.off;
    };
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < lanes; ++x) {
            const double right = sample_place(x), below = sample_place(y);
            const std::complex<float> phase(
                optics::unit_phasor(cycles(across, right) + cycles(down, below) + bend * right * below));
            phases[2 * y * row + x] = phase.real();
            phases[(2 * y + 1) * row + x] = phase.imag();
        }
}

}  // namespace hogel::camera::hogel_spectra
