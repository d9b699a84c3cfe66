// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/histogram_tone_mapping.h"

#include <algorithm>
#include <cmath>

namespace hogel::codec::encode {

using namespace format;

namespace {

constexpr std::size_t per_octave = std::size_t{1} << (23 - ToneCurve::low_bits);
constexpr std::size_t max_octaves = 20;
constexpr double evenly = 0.1;  // fraction of all samples that is treated as evenly distributed

// Returns the slopes of the curve over the logarithm: proportional to the densities, at most 1, with a total rise of
// `height`. `height` must be less than the sum of the widths. The paper iterates until few samples are above the
// ceiling; here none is.
std::vector<double> limited_slopes(const std::vector<double>& densities, const std::vector<double>& widths,
                                   double height) {
    std::vector<double> slopes(densities.size(), 0);
    for (bool changed = true; changed;) {
        double left = height, mass = 0;
        for (std::size_t i = 0; i < slopes.size(); ++i)
            slopes[i] == 1 ? left -= widths[i] : mass += densities[i] * widths[i];
        changed = false;
        for (std::size_t i = 0; i < slopes.size(); ++i) {
            if (slopes[i] == 1) continue;
            slopes[i] = std::min(1.0, densities[i] * left / mass);
            changed = changed || slopes[i] == 1;
        }
    }
    return slopes;
}

}  // namespace

std::optional<ToneCurve> tone_curve_of(const LuminanceHistogram& histogram, double decades) {
    // Only the bins of normal (not subnormal) numbers.
    const std::span<const std::uint64_t> counts = std::span(histogram.counts()).subspan(per_octave, 254 * per_octave);
    const auto is_positive = [](std::uint64_t count) { return count > 0; };
    const auto highest = std::find_if(counts.rbegin(), counts.rend(), is_positive);
    if (highest == counts.rend()) return std::nullopt;
    const auto end = static_cast<std::size_t>(counts.rend() - highest);
    const auto lowest = static_cast<std::size_t>(std::ranges::find_if(counts, is_positive) - counts.begin());
    const std::size_t begin = std::max(lowest, end - std::min(end, max_octaves * per_octave));
    std::vector<double> widths, densities;
    double width = 0, total = 0;
    for (std::size_t bin = begin; bin < end; ++bin) {
        const double mantissa = static_cast<double>(per_octave + bin % per_octave);
        widths.push_back(std::log2((mantissa + 1) / mantissa));
        width += widths.back();
        total += static_cast<double>(counts[bin]);
    }
    const double height = decades * std::log2(10.0);
    if (width <= height) return std::nullopt;
    for (std::size_t i = 0; i < widths.size(); ++i)
        densities.push_back((1 - evenly) * static_cast<double>(counts[begin + i]) / widths[i] + evenly * total / width);
    const std::vector<double> slopes = limited_slopes(densities, widths, height);
    // If the last bin ends at infinity, the last point is the bin's beginning.
    const auto first = static_cast<std::uint32_t>(begin + per_octave);
    const std::size_t last = end == counts.size() ? end - 1 : end;
    std::vector<float> values(last - begin + 1);
    double y = std::bit_cast<float>(static_cast<std::uint32_t>(last + per_octave) << ToneCurve::low_bits);
    for (std::size_t i = values.size(); i-- > 0;) {
        values[i] = static_cast<float>(y);
        if (i > 0) y *= std::exp2(-slopes[i - 1] * widths[i - 1]);
    }
    return ToneCurve(first, std::move(values));
}

}  // namespace hogel::codec::encode
