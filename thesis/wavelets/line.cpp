// SPDX-License-Identifier: Apache-2.0
#include "thesis/wavelets/line.h"

#include <algorithm>

namespace hogel::wavelets {

WaveletLine::WaveletLine(const Wavelet& wavelet, std::size_t length)
    : length_(length), coarse_count_((length + 1) / 2), before_(length), after_(length) {
    const std::size_t detail_count = length / 2;
    for (const LiftingStep& step : wavelet.steps) {
        const bool to_detail = step.target == Half::detail;
        const std::size_t target_row = to_detail ? coarse_count_ : 0, source_row = to_detail ? 0 : coarse_count_;
        const auto targets = static_cast<std::ptrdiff_t>(to_detail ? detail_count : coarse_count_);
        const auto sources = static_cast<std::ptrdiff_t>(to_detail ? coarse_count_ : detail_count);
        const auto tap_count = std::ssize(step.taps);
        // Targets i with 0 <= i + first and i + first + tap_count <= sources.
        const std::ptrdiff_t begin = std::clamp<std::ptrdiff_t>(-step.first, 0, targets);
        const std::ptrdiff_t end = std::clamp<std::ptrdiff_t>(sources - tap_count - step.first + 1, begin, targets);
        Step plan;
        plan.count = static_cast<std::size_t>(end - begin);
        plan.inner = {target_row + static_cast<std::size_t>(begin),
                      plan.count > 0 ? source_row + static_cast<std::size_t>(begin + step.first) : 0,
                      {step.taps.begin(), step.taps.end()}};
        const std::ptrdiff_t known = std::min<std::ptrdiff_t>(step.extension, sources);
        for (std::ptrdiff_t i = 0; i < targets; ++i) {
            if (i >= begin && i < end) continue;
            // Taps outside the source are folded onto the samples that determine its continuation.
            std::vector<double> folded(static_cast<std::size_t>(sources));
            for (std::ptrdiff_t k = 0; k < tap_count; ++k) {
                const std::ptrdiff_t position = i + step.first + k;
                const double tap = step.taps[static_cast<std::size_t>(k)];
                if (position >= 0 && position < sources) {
                    folded[static_cast<std::size_t>(position)] += tap;
                    continue;
                }
                const bool is_before_start = position < 0;
                const std::vector<double> weights =
                    extrapolation(static_cast<std::size_t>(known), is_before_start ? position : sources - 1 - position);
                for (std::size_t p = 0; p < weights.size(); ++p)
                    folded[is_before_start ? p : static_cast<std::size_t>(sources) - 1 - p] += tap * weights[p];
            }
            const auto nonzero = [](double value) { return value != 0; };
            const auto first = std::find_if(folded.begin(), folded.end(), nonzero);
            const auto last = std::find_if(folded.rbegin(), folded.rend(), nonzero).base();
            if (first >= last) continue;
            plan.edges.push_back({target_row + static_cast<std::size_t>(i),
                                  source_row + static_cast<std::size_t>(first - folded.begin()),
                                  {first, last}});
        }
        steps_.push_back(std::move(plan));
    }
}

void WaveletLine::apply(const Row& row, std::size_t count, float sign, float* rows) {
    for (std::size_t i = 0; i < count; ++i) {
        float* target = rows + (row.target + i) * lane_count;
        const float* source = rows + (row.source + i) * lane_count;
        float sum[lane_count];
        for (std::size_t lane = 0; lane < lane_count; ++lane) sum[lane] = target[lane];
        for (std::size_t k = 0; k < row.taps.size(); ++k) {
            const float tap = sign * row.taps[k];
            for (std::size_t lane = 0; lane < lane_count; ++lane) sum[lane] += tap * source[k * lane_count + lane];
        }
        for (std::size_t lane = 0; lane < lane_count; ++lane) target[lane] = sum[lane];
    }
}

void WaveletLine::set_scales(const std::vector<double>& is_before_start, const std::vector<double>& after) {
    for (std::size_t row = 0; row < length_; ++row) {
        const double in = is_before_start[sample_of_row(row)], out = after[row];
        before_[row] = {static_cast<float>(1 / in), static_cast<float>(in)};
        after_[row] = {static_cast<float>(out), static_cast<float>(1 / out)};
    }
}

void WaveletLine::forward(float* rows) const {
    const auto scale = [&](const std::vector<Scale>& scales) {
        for (std::size_t row = 0; row < length_; ++row)
            for (std::size_t lane = 0; lane < lane_count; ++lane) rows[row * lane_count + lane] *= scales[row].forward;
    };
    scale(before_);
    for (const Step& step : steps_) {
        apply(step.inner, step.count, 1, rows);
        for (const Row& edge : step.edges) apply(edge, 1, 1, rows);
    }
    scale(after_);
}

void WaveletLine::inverse(float* rows) const {
    const auto scale = [&](const std::vector<Scale>& scales) {
        for (std::size_t row = 0; row < length_; ++row)
            for (std::size_t lane = 0; lane < lane_count; ++lane) rows[row * lane_count + lane] *= scales[row].inverse;
    };
    scale(after_);
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
        apply(step->inner, step->count, -1, rows);
        for (const Row& edge : step->edges) apply(edge, 1, -1, rows);
    }
    scale(before_);
}

}  // namespace hogel::wavelets
