// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/camera/hogel_spectra/slepian_basis.h"

namespace hogel::camera::hogel_spectra {

/// A line of samples whose phase is √((first + step · position)² + square) · frequency − offset cycles, with the
/// position counted in samples from the middle.
struct SampleLine {
    double first = 0, step = 0, square = 0;
    double frequency = 0;  ///< cycles per metre
    double offset = 0;
};

constexpr double sample_position(std::size_t sample) {
    return static_cast<double>(sample) - 0.5 * static_cast<double>(lanes - 1);
}

/// Computes the phases of the demodulation at a square of `lanes` × `lanes` samples of a band, or at its first rows:
/// e^{2πi (across(x) + down(y) + bend · x · y)} for the positions x and y. The bend must be small: 2π · bend · x · y
/// below 0.1. Plain and fast twins agree to 1e-6 of the phase by which a line changes.
/// @param phases      [row][part][column], aligned to a cache line
/// @param row_stride  floats from one part to the next
void demodulation_plain(const SampleLine& across, const SampleLine& down, double bend, std::size_t rows, float* phases,
                        std::size_t row_stride);
extern decltype(demodulation_plain)& demodulation;

}  // namespace hogel::camera::hogel_spectra
