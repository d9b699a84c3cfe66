// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace hogel::render {

/// Distance from an edge, in samples, within which samples are candidates for ObliqueTriangle's test. It exceeds all
/// rounding errors and is so small that few samples are found twice.
constexpr double scan_margin = 1e-6;

struct Span {  // samples first <= i < end
    std::size_t first = 0, end = 0;

    std::size_t size() const { return end - first; }
};

/// Returns the integers of [0, n) from `low` to `high`, both widened by the margin.
inline Span samples_between(double low, double high, std::size_t n) {
    const double from = low - scan_margin, to = high + scan_margin;
    if (!(from <= to) || to < 0 || from > static_cast<double>(n - 1)) return {};
    // Conversions truncate, which is faster than std::ceil and std::floor.
    std::size_t first = from > 0 ? static_cast<std::size_t>(from) : 0;
    if (static_cast<double>(first) < from) ++first;
    const std::size_t end = to < static_cast<double>(n - 1) ? static_cast<std::size_t>(to) + 1 : n;
    return first < end ? Span{first, end} : Span{};
}

}  // namespace hogel::render
