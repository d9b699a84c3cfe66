// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/tone_curve.h"

#include <algorithm>

#include "hogel/error.h"

namespace hogel::codec::format {

ToneCurve::ToneCurve(std::uint32_t first, std::vector<float> values) : first_(first), values_(std::move(values)) {
    constexpr std::uint32_t min_normal = 1 << (23 - low_bits), end = 0xFF << (23 - low_bits);  // of normal numbers
    constexpr float max_factor = 0x1p64f;
    const auto refuse = [](const char* why) { throw Error(ErrorCode::bad_input, why); };
    const std::size_t count = values_.size();
    if (count < 2 || count > max_points) refuse("a tone curve with an impossible number of points");
    if (first_ < min_normal || first_ > end - count) refuse("a tone curve whose points are not normal numbers");
    for (std::size_t i = 0; i < count; ++i) {
        const float factor = values_[i] / point(i);
        if (!std::isnormal(values_[i]) || !(factor >= 1 / max_factor && factor <= max_factor))
            refuse("a tone curve with impossible values");
        if (i > 0 && !(values_[i] > values_[i - 1])) refuse("a tone curve that does not increase");
    }
    lowest_ = point(0);
    highest_ = point(count - 1);
    below_ = values_.front() / lowest_;
    above_ = values_.back() / highest_;
    inverse_below_ = lowest_ / values_.front();
    inverse_above_ = highest_ / values_.back();
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const float across = point(i + 1) - point(i), up = values_[i + 1] - values_[i];
        pieces_.push_back({point(i), values_[i], up / across, across / up});
    }
    const auto bucket = [](float y) { return std::bit_cast<std::uint32_t>(y) >> bucket_bits; };
    first_bucket_ = bucket(values_.front());
    std::uint16_t piece = 0;
    for (std::uint32_t k = first_bucket_; k <= bucket(values_.back()); ++k) {
        while (piece + 2u < count && values_[piece + 1] <= std::bit_cast<float>(k << bucket_bits)) ++piece;
        begin_.push_back(piece);
    }
}

double ToneCurve::decades() const { return std::log10(static_cast<double>(highest_) / lowest_); }

double ToneCurve::mapped_decades() const { return std::log10(static_cast<double>(values_.back()) / values_.front()); }

void LuminanceHistogram::add(const LuminanceHistogram& other) {
    std::ranges::transform(counts_, other.counts_, counts_.begin(), std::plus<>{});
}

}  // namespace hogel::codec::format
