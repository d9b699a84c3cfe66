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
    const double first_position = low - scan_margin, last_position = high + scan_margin;
    if (!(first_position <= last_position) || last_position < 0 || first_position > static_cast<double>(n - 1))
        return {};
    // Conversions truncate, which is faster than std::ceil and std::floor.
    std::size_t first = first_position > 0 ? static_cast<std::size_t>(first_position) : 0;
    if (static_cast<double>(first) < first_position) ++first;
    const std::size_t end =
        last_position < static_cast<double>(n - 1) ? static_cast<std::size_t>(last_position) + 1 : n;
    return first < end ? Span{first, end} : Span{};
}

}  // namespace hogel::render
