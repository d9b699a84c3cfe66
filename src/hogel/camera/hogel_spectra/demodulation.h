// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/camera/hogel_spectra/slepian_basis.h"

namespace hogel::camera::hogel_spectra {

/// A line of samples: √((first + step · place)² + square) frequency − off cycles at a place, counted in samples from
/// the middle.
struct SampleLine {
    double first = 0, step = 0, square = 0;
    double frequency = 0;  ///< cycles per metre
    double off = 0;
};

/// The place of one of `lanes` samples.
constexpr double sample_place(std::size_t sample) {
    return static_cast<double>(sample) - 0.5 * static_cast<double>(lanes - 1);
}

/// The phases of the demodulation at a square of `lanes` samples of a band, or at its first rows: e^{2πi (across + down
/// + bend · right · below)} for samples at the places `right` and `below`. The bend is small: 2π bend times both places
/// is below 0.1. Plain and fast twins agree to 1e-6 of the phase by which a line changes.
/// @param phases  [row][part][column], aligned to a cache line; parts are `row` floats apart
void demodulation_plain(const SampleLine& across, const SampleLine& down, double bend, std::size_t rows, float* phases,
                        std::size_t row);
extern decltype(demodulation_plain)& demodulation;

}  // namespace hogel::camera::hogel_spectra
