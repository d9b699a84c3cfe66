// SPDX-License-Identifier: Apache-2.0
#include "thesis/wavelets/line.h"

#include <algorithm>

namespace hogel::wavelets {
namespace {

struct Halves {
    std::vector<double> coarse, detail;
};

// Returns source[position], continued beyond its ends.
double continued(std::span<const double> source, std::ptrdiff_t position, int extension) {
    const auto count = std::ssize(source);
    if (position >= 0 && position < count) return source[static_cast<std::size_t>(position)];
    const bool is_before_start = position < 0;
    const auto known = static_cast<std::size_t>(std::min<std::ptrdiff_t>(extension, count));
    const std::vector<double> weights = extrapolation(known, is_before_start ? position : count - 1 - position);
    double sum = 0;
    for (std::size_t p = 0; p < known; ++p) sum += weights[p] * source[is_before_start ? p : source.size() - 1 - p];
    return sum;
}

void lift(const LiftingStep& step, double sign, Halves& halves) {
    std::vector<double>& target = step.target == Half::detail ? halves.detail : halves.coarse;
    const std::vector<double>& source = step.target == Half::detail ? halves.coarse : halves.detail;
    for (std::size_t i = 0; i < target.size(); ++i)
        for (std::size_t k = 0; k < step.taps.size(); ++k)
            target[i] += sign * step.taps[k] *
                         continued(source, static_cast<std::ptrdiff_t>(i + k) + step.first, step.extension);
}

}  // namespace

std::vector<double> extrapolation(std::size_t count, std::ptrdiff_t position) {
    std::vector<double> weights(count, 1.0);  // Lagrange polynomials at `position`
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t q = 0; q < count; ++q)
            if (q != p)
                weights[p] *= (static_cast<double>(position) - static_cast<double>(q)) /
                              (static_cast<double>(p) - static_cast<double>(q));
    return weights;
}

void forward_line_plain(const Wavelet& wavelet, std::span<double> line) {
    Halves halves;
    for (std::size_t k = 0; k < line.size(); ++k) (k % 2 == 0 ? halves.coarse : halves.detail).push_back(line[k]);
    for (const LiftingStep& step : wavelet.steps) lift(step, 1, halves);
    auto out = line.begin();
    for (double value : halves.coarse) *out++ = value;
    for (double value : halves.detail) *out++ = value;
}

void inverse_line_plain(const Wavelet& wavelet, std::span<double> line) {
    Halves halves;
    const std::size_t middle = (line.size() + 1) / 2;
    for (std::size_t k = 0; k < line.size(); ++k) (k < middle ? halves.coarse : halves.detail).push_back(line[k]);
    for (auto step = wavelet.steps.rbegin(); step != wavelet.steps.rend(); ++step) lift(*step, -1, halves);
    for (std::size_t k = 0; k < line.size(); ++k) line[k] = (k % 2 == 0 ? halves.coarse : halves.detail)[k / 2];
}

}  // namespace hogel::wavelets
