// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>

#include "hogel/array.h"

namespace hogel::camera::narrow_band {

/// Inner loops of the narrow-band camera. Plain and fast twins agree to rounding.

/// Low-pass and decimation down the columns of a tile: out[m·out_stride + x] = Σ_k taps[k] · phases[r] · rows[r·stride
/// + x] with r = first + m·step + k in 0 … phases.size() − 1, for m < count and x < width. `first` may be negative.
struct ColumnDecimation {
    std::size_t width = 0, stride = 0, step = 1;
    std::ptrdiff_t first = 0;
    std::span<const float> taps;
    std::span<const std::complex<float>> phases;
};
void decimated_columns_plain(const std::complex<float>* rows, const ColumnDecimation& decimation,
                             std::complex<float>* out, std::size_t out_stride, std::size_t count);
extern decltype(decimated_columns_plain)& decimated_columns;

/// Computes the phases of the paths from the points of a line in float precision: out[i] = e^{2πi (√(d² +
/// square)/wavelength − offset)} with d = first + i · pitch.
struct PathPhases {
    double first = 0, pitch = 0, square = 0, wavelength = 1, offset = 0;
};
void path_phases_plain(const PathPhases& paths, std::span<std::complex<float>> out);
extern decltype(path_phases_plain)& path_phases;

/// Low-pass and decimation along a line: out[n] = Σ_k taps[2k] · line[n·step + k]. Each tap is stored twice.
void decimated_line_plain(const std::complex<float>* line, std::size_t step, std::span<const float> taps,
                          std::span<std::complex<float>> out);
extern decltype(decimated_line_plain)& decimated_line;

}  // namespace hogel::camera::narrow_band
