// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace hogel::codec::format {

/// Strictly increasing, odd function y(L) of luminance, and its inverse. It is piecewise linear between points: the
/// binary32 numbers with 20 low zero bits (eight per octave). Below the first and above the last point it is
/// proportional to L. It uses only basic operations of binary32, so that all machines agree.
class ToneCurve {
  public:
    static constexpr int low_bits = 20;  // number of low zero bits of a point
    static constexpr std::size_t max_points = 512;

    /// @param first    the first point: the bits of its luminance as binary32, without the lowest 20
    /// @param values   y at the first and the following points
    /// Throws Error(bad_input) unless there are 2 to max_points points, all numbers are normal, the values increase,
    /// and the ratio of each value to its point is between 2^−64 and 2^64.
    ToneCurve(std::uint32_t first, std::vector<float> values);

    /// Returns the luminance of point i.
    float point(std::size_t i) const { return point_at(first_ + static_cast<std::uint32_t>(i)); }
    std::uint32_t first() const { return first_; }
    const std::vector<float>& values() const { return values_; }
    /// Return the number of decades (factors of ten) from the first to the last point, of luminance and of y.
    double decades() const;
    double mapped_decades() const;

    /// Returns y(L)/L, and its limit at 0.
    float factor(float luminance) const {
        const float l = std::abs(luminance);
        if (!(l > lowest_)) return below_;
        if (!(l < highest_)) return above_;
        const std::size_t i = (std::bit_cast<std::uint32_t>(l) >> low_bits) - first_;
        const Piece& piece = pieces_[i];
        return (piece.value + (l - piece.point) * piece.slope) / l;
    }
    /// Returns L(y)/y, and its limit at 0.
    float inverse_factor(float mapped) const {
        const float y = std::abs(mapped);
        if (!(y > values_.front())) return inverse_below_;
        if (!(y < values_.back())) return inverse_above_;
        std::size_t i = begin_[(std::bit_cast<std::uint32_t>(y) >> bucket_bits) - first_bucket_];
        while (!(y < values_[i + 1])) ++i;
        const Piece& piece = pieces_[i];
        return (piece.point + (y - piece.value) * piece.inverse_slope) / y;
    }

    friend bool operator==(const ToneCurve& a, const ToneCurve& b) {
        return a.first_ == b.first_ && a.values_ == b.values_;
    }

  private:
    struct Piece {
        float point, value, slope, inverse_slope;
    };
    static constexpr int bucket_bits = 16;

    static float point_at(std::uint32_t high) { return std::bit_cast<float>(high << low_bits); }

    std::uint32_t first_;
    std::vector<float> values_;
    float lowest_, highest_, below_, above_, inverse_below_, inverse_above_;
    std::vector<Piece> pieces_;
    std::uint32_t first_bucket_;
    std::vector<std::uint16_t> begin_;  // [highest bits of y]: the first segment that may contain y
};

/// Histogram of the luminances |L| of a light field, with bins between consecutive points of a ToneCurve.
class LuminanceHistogram {
  public:
    LuminanceHistogram() : counts_(std::size_t{1} << (31 - ToneCurve::low_bits)) {}
    explicit LuminanceHistogram(std::vector<std::uint64_t> counts) : counts_(std::move(counts)) {}
    void add(float luminance) {
        ++counts_[(std::bit_cast<std::uint32_t>(luminance) & 0x7FFFFFFF) >> ToneCurve::low_bits];
    }
    void add(const LuminanceHistogram& other);
    const std::vector<std::uint64_t>& counts() const { return counts_; }

  private:
    std::vector<std::uint64_t> counts_;
};

}  // namespace hogel::codec::format
