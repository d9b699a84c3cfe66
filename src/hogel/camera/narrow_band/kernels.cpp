// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/narrow_band/kernels.h"

#include <cmath>

#include "hogel/optics/phase_walk.h"

namespace hogel::camera::narrow_band {

void decimated_columns_plain(const std::complex<float>* rows, const ColumnDecimation& decimation,
                             std::complex<float>* out, std::size_t out_stride, std::size_t count) {
    for (std::size_t m = 0; m < count; ++m)
        for (std::size_t x = 0; x < decimation.width; ++x) {
            std::complex<float> sum = 0;
            for (std::size_t k = 0; k < decimation.taps.size(); ++k) {
                const std::ptrdiff_t r = decimation.first + static_cast<std::ptrdiff_t>(m * decimation.step + k);
                if (r < 0 || r >= static_cast<std::ptrdiff_t>(decimation.phases.size())) continue;
                const auto row = static_cast<std::size_t>(r);
                sum += decimation.taps[k] * optics::times(decimation.phases[row], rows[row * decimation.stride + x]);
            }
            out[m * out_stride + x] = sum;
        }
}

void path_phases_plain(const PathPhases& paths, std::span<std::complex<float>> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double d = paths.first + static_cast<double>(i) * paths.pitch;
        out[i] =
            std::complex<float>(optics::unit_phasor(std::sqrt(d * d + paths.square) / paths.wavelength - paths.offset));
    }
}

void decimated_line_plain(const std::complex<float>* line, std::size_t step, std::span<const float> taps,
                          std::span<std::complex<float>> out) {
    for (std::size_t n = 0; n < out.size(); ++n) {
        std::complex<float> sum = 0;
        for (std::size_t k = 0; k < taps.size() / 2; ++k) sum += taps[2 * k] * line[n * step + k];
        out[n] = sum;
    }
}

}  // namespace hogel::camera::narrow_band
