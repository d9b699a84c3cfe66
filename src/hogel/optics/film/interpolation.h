// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <type_traits>
#include <vector>

#include "hogel/array.h"
#include "hogel/optics/low_pass.h"

namespace hogel::optics::film {

/// LowPass as an interpolation kernel, tabulated by the fraction of a sample: ten taps around a position between two
/// samples, each stored twice, for the real and the imaginary part. A band-limited signal changes by less than 1e-3 of
/// its value over half a table step.
class InterpolationTable {
  public:
    static constexpr std::ptrdiff_t taps = 10;
    static constexpr std::size_t phases = 1024;

    InterpolationTable() {
        for (std::size_t phase = 0; phase <= phases; ++phase)
            for (std::ptrdiff_t k = 0; k < taps; ++k) {
                const double distance =
                    static_cast<double>(k) - 4 - static_cast<double>(phase) / static_cast<double>(phases);
                weights_.insert(weights_.end(), 2, static_cast<float>(LowPass::at(distance)));
            }
    }

    /// The value of line[…] (count values, zero outside) at a position between samples.
    std::complex<float> at(const std::complex<float>* line, std::size_t count, double place) const {
        const double whole = std::floor(place);
        const auto first = static_cast<std::ptrdiff_t>(whole) - 4;
        const double nearest = (place - whole) * phases + 0.5;
        const float* w = &weights_[static_cast<std::size_t>(nearest) * 2 * taps];
        if (first >= 0 && first + taps <= static_cast<std::ptrdiff_t>(count)) {
            const auto* z = reinterpret_cast<const float*>(line + first);
            float sum[4] = {0, 0, 0, 0};
            for (std::ptrdiff_t k = 0; k < 2 * taps; k += 4)
                for (std::ptrdiff_t i = 0; i < 4; ++i) sum[i] += w[k + i] * z[k + i];
            return {sum[0] + sum[2], sum[1] + sum[3]};
        }
        float re = 0, im = 0;
        for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, -first);
             k < std::min(taps, static_cast<std::ptrdiff_t>(count) - first); ++k) {
            re += w[2 * k] * line[first + k].real();
            im += w[2 * k] * line[first + k].imag();
        }
        return {re, im};
    }

  private:
    std::vector<float> weights_;
};

/// Catmull–Rom interpolation between four neighbours of value(0 … count − 1), zero outside. Linear interpolation would
/// be too coarse for intensities, which have two samples per period of their finest wave. Values may be complex.
template <class Value>
auto cubic_at(std::size_t count, double place, const Value& value) {
    using Result = std::decay_t<decltype(value(0))>;
    const double whole = std::floor(place);
    if (!(whole >= 1 && whole + 2 < static_cast<double>(count))) return Result{};
    const auto i = static_cast<std::size_t>(whole);
    const auto x = static_cast<float>(place - whole);
    const Result a = value(i - 1), b = value(i), c = value(i + 1), d = value(i + 2);
    return b + 0.5f * x * ((c - a) + x * ((2.0f * a - 5.0f * b + 4.0f * c - d) + x * (3.0f * (b - c) + d - a)));
}

/// The same in two dimensions, for value(row, column).
template <class Value>
auto cubic_at(std::size_t height, std::size_t width, double row, double column, const Value& value) {
    return cubic_at(height, row,
                    [&](std::size_t j) { return cubic_at(width, column, [&](std::size_t i) { return value(j, i); }); });
}

}  // namespace hogel::optics::film
