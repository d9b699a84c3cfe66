// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/demodulation.h"

#include <cmath>
#include <complex>

#include "hogel/optics/phase_walk.h"

namespace hogel::camera::hogel_spectra {

void demodulation_plain(const SampleLine& across, const SampleLine& down, double bend, std::size_t rows, float* phases,
                        std::size_t row_stride) {
    const auto cycles = [](const SampleLine& line, double position) {
        const double along = line.first + line.step * position;
        return std::sqrt(along * along + line.square) * line.frequency - line.offset;
    };
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < lanes; ++x) {
            const double right = sample_position(x), down_offset = sample_position(y);
            const std::complex<float> phase(
                optics::unit_phasor(cycles(across, right) + cycles(down, down_offset) + bend * right * down_offset));
            phases[2 * y * row_stride + x] = phase.real();
            phases[(2 * y + 1) * row_stride + x] = phase.imag();
        }
}

}  // namespace hogel::camera::hogel_spectra
