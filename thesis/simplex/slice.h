// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/render/span.h"
#include "thesis/simplex/volume.h"

namespace hogel::simplex {

// Points have `Size` coordinates: those of ProjectedPoint, optionally followed by interpolated values.

/// Returns whether a point precedes another along an axis; ties are resolved by the other coordinates.
template <std::size_t Size>
bool is_before(const std::array<double, Size>& a, const std::array<double, Size>& b, std::size_t axis) {
    return a[axis] != b[axis] ? a[axis] < b[axis] : a < b;
}

/// Sorts the corners of a simplex along an axis. Simplices that share corners then have them in the same order, so
/// slices through shared faces are bit for bit equal.
template <std::size_t Size, std::size_t N>
void sort_along(std::size_t axis, std::array<std::array<double, Size>, N>& corners) {
    using Point = std::array<double, Size>;
    std::sort(corners.begin(), corners.end(), [axis](const Point& a, const Point& b) {
        // Moved-from arrays of numbers keep their values. NOLINTNEXTLINE(clang-analyzer-cplusplus.Move)
        return is_before(a, b, axis);
    });
}

/// Returns the samples of [0, n) whose planes cut an object that extends from `first` to `last` along an axis: first <
/// sample <= last.
inline render::Span samples_cut(double first, double last, std::size_t n) {
    const double from = std::max(std::floor(first) + 1, 0.0);
    const double upto = std::min(std::floor(last), static_cast<double>(n) - 1);
    if (!(from <= upto)) return {};
    return {static_cast<std::size_t>(from), static_cast<std::size_t>(upto) + 1};
}

/// Returns the point between a and b with the coordinate `value` along an axis; a[axis] < value <= b[axis].
template <std::size_t Size>
std::array<double, Size> point_between(const std::array<double, Size>& a, const std::array<double, Size>& b,
                                       std::size_t axis, double value) {
    const double f = (value - a[axis]) / (b[axis] - a[axis]);
    std::array<double, Size> p;
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = a[i] + f * (b[i] - a[i]);
    p[axis] = value;
    return p;
}

/// Calls use(Simplex<N − 1>) for the one to three simplices of the intersection of the plane axis = value with a
/// simplex whose corners are sorted along that axis; for none unless the plane separates corners. Source: [K] 5.6.2,
/// fig. 5.19 and 5.20.
template <std::size_t Size, std::size_t N, class Use>
void slice(const std::array<std::array<double, Size>, N>& sorted, std::size_t axis, double value, const Use& use) {
    std::size_t below = 0;
    while (below < N && sorted[below][axis] < value) ++below;
    if (below == 0 || below == N) return;
    // The intersections of the plane with edges from below to above form a (below − 1, above − 1)-simploid.
    std::array<std::array<std::array<double, Size>, N>, N> crossing;
    for (std::size_t i = 0; i < below; ++i)
        for (std::size_t j = below; j < N; ++j)
            crossing[i][j - below] = point_between(sorted[i], sorted[j], axis, value);
    for (const auto& path : product_paths<N - 1>(below - 1)) {
        std::array<std::array<double, Size>, N - 1> piece;
        for (std::size_t k = 0; k < piece.size(); ++k) piece[k] = crossing[path[k].first][path[k].second];
        use(piece);
    }
}

/// Calls use(value, Simplex<N − 1>) for the slices of a simplex at the samples of an axis. Source: [K] 5.7.3. Differs:
/// [K] 5.7.2 first clips simplices to the field of view, which cuts one into up to six at each of four edges. No sample
/// lies outside, so skipping the slices there has the same result.
/// @param seen  for each sample, whether a slice there may contain a hogel; other samples are skipped
template <std::size_t Size, std::size_t N, class Use>
void slice_at_samples(std::array<std::array<double, Size>, N> simplex, std::size_t axis,
                      std::span<const std::uint8_t> seen, const Use& use) {
    sort_along(axis, simplex);
    const render::Span cut = samples_cut(simplex.front()[axis], simplex.back()[axis], seen.size());
    for (std::size_t i = cut.first; i < cut.end; ++i) {
        if (seen[i] == 0) continue;
        const auto value = static_cast<double>(i);
        slice(simplex, axis, value, [&](const auto& piece) { use(value, piece); });
    }
}

/// Replaces simplices of four or five corners by their parts where axis >= bound (keep_above) or axis < bound
/// (otherwise), as simplices. Source: [K] 5.6.2, fig. 5.18.
template <std::size_t N>
void clip(std::vector<std::array<ProjectedPoint, N>>& simplices, std::size_t axis, double bound, bool keep_above);

}  // namespace hogel::simplex
