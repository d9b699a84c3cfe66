// SPDX-License-Identifier: Apache-2.0
#include "hogel/coding/histogram_rule.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "hogel/error.h"

namespace hogel::coding {
namespace {

constexpr int dropped = 18;
constexpr int max_planes = 29;

double lower_edge(std::size_t bin) { return std::bit_cast<float>(static_cast<std::uint32_t>(bin) << dropped); }

}  // namespace

float max_magnitude(std::span<const float> values) {
    float max_value = 0;
    bool finite = true;
    for (float value : values) {
        finite = finite && std::isfinite(value);
        max_value = std::max(max_value, std::abs(value));
    }
    if (!finite) throw Error(ErrorCode::usage, "coding: a value is infinite or not a number, expected finite ones");
    return max_value;
}

MagnitudeHistogram::MagnitudeHistogram() : counts_(std::size_t{1} << (31 - dropped)) {}

void MagnitudeHistogram::add(std::span<const float> values) {
    max_ = std::max(max_, max_magnitude(values));
    for (const float value : values) ++counts_[std::bit_cast<std::uint32_t>(std::abs(value)) >> dropped];
}

void MagnitudeHistogram::add(const MagnitudeHistogram& other) {
    max_ = std::max(max_, other.max_);
    for (std::size_t bin = 0; bin < counts_.size(); ++bin) counts_[bin] += other.counts_[bin];
}

double MagnitudeHistogram::bits(double step, double c) const {
    double sum = 0;
    for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
        // Magnitudes from 2^(n−1) to 2^n steps have levels of n bits.
        const double steps = lower_edge(bin) / step;
        if (counts_[bin] > 0 && steps >= 1) sum += static_cast<double>(counts_[bin]) * (std::ilogb(steps) + 1 + c);
    }
    return sum;
}

double MagnitudeHistogram::step(double requested, double c) const {
    if (max_ == 0) return 1;
    double coarse = max_, fine = std::ldexp(max_, -max_planes);
    while (coarse > fine * 1.001) {
        const double middle = std::sqrt(coarse * fine);
        (bits(middle, c) <= requested ? coarse : fine) = middle;
    }
    return coarse;
}

double MagnitudeHistogram::step_of_planes(double requested, double c) const {
    if (max_ == 0) return 1;
    double best = max_, least = std::numeric_limits<double>::infinity();
    for (int planes = 1; planes <= max_planes; ++planes) {
        const double step = std::ldexp(max_, -planes), miss = std::abs(std::log(bits(step, c) / requested));
        if (miss < least) {
            least = miss;
            best = step;
        }
    }
    return best;
}

}  // namespace hogel::coding
