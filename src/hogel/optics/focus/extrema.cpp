// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/focus/extrema.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace hogel::optics {
namespace {

// How far a curve goes up and down from sample to sample: by no more than this nine samples of ten are off from their
// neighbours' mean. The tenth may be a plane in focus.
double noise_of(const std::vector<double>& curve) {
    std::vector<double> off;
    for (std::size_t i = 1; i + 1 < curve.size(); ++i)
        off.push_back(std::abs(curve[i] - (curve[i - 1] + curve[i + 1]) / 2));
    const std::size_t most = off.size() * 9 / 10;
    std::ranges::nth_element(off, off.begin() + static_cast<std::ptrdiff_t>(most));
    return off[most];
}

// The maxima of a curve that is not at its ends, with how far one must descend from each to reach a higher one.
std::vector<Extremum> maxima_of(const std::vector<double>& curve) {
    std::vector<Extremum> found;
    const std::size_t n = curve.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
        if (!(curve[i] > curve[i - 1] && curve[i] >= curve[i + 1])) continue;
        std::size_t left = i, right = i;
        for (std::size_t j = i; j-- > 0 && curve[j] <= curve[i];)
            if (curve[j] < curve[left]) left = j;
        for (std::size_t j = i + 1; j < n && curve[j] <= curve[i]; ++j)
            if (curve[j] < curve[right]) right = j;
        Extremum extremum{i};
        extremum.base = curve[left] > curve[right] ? left : right;
        extremum.prominence = curve[i] - curve[extremum.base];
        // Halfway down, or where high peaks have fallen to 0.7.
        const double near = curve[i] - std::min(extremum.prominence / 2, 0.35);
        for (extremum.first = i; extremum.first > 0 && curve[extremum.first - 1] >= near;) --extremum.first;
        for (extremum.last = i; extremum.last + 1 < n && curve[extremum.last + 1] >= near;) ++extremum.last;
        const double half = curve[i] - extremum.drop();
        for (extremum.begin = i; extremum.begin > 0 && curve[extremum.begin - 1] >= half;) --extremum.begin;
        for (extremum.end = i; extremum.end + 1 < n && curve[extremum.end + 1] >= half;) ++extremum.end;
        found.push_back(extremum);
    }
    return found;
}

// Extrema of both kinds at all scales that stand out of the noise and are no wider than defocus makes them: a square
// of n samples is blurred away in about n depths of focus, more where the light has not all frequencies of the samples.
std::vector<Extremum> extrema_of(std::span<const Contrasts> contrasts, double step, double light_depth) {
    // Measured on the fields of docs/holograms-from-elsewhere.md (docs/decisions/0085-planes-in-focus.md).
    constexpr double least = 0.08, above_noise = 4, widest = 8;
    std::vector<Extremum> found, too_wide;
    for (std::size_t s = 0; s <= FocusSearch::edges; ++s) {
        std::vector<double> curve;
        for (const Contrasts& contrast : contrasts) curve.push_back(height_of(contrast, s));
        const double noise = noise_of(curve);
        // Edges of light with few frequencies are as wide as the largest squares.
        const std::size_t cell = FocusSearch::cells[std::min(s, FocusSearch::cells.size() - 1)];
        for (const bool maximum : {true, false}) {
            for (Extremum extremum : maxima_of(curve)) {
                extremum.scale = s;
                extremum.maximum = maximum;
                const double width =
                    static_cast<double>(std::max<std::size_t>(extremum.last - extremum.first, 1)) * step / 2;
                extremum.slope = extremum.prominence / width;
                const bool wide = width > widest * std::max(static_cast<double>(cell), light_depth);
                if (s == FocusSearch::edges && !maximum) continue;
                if (extremum.prominence > least && extremum.prominence > above_noise * noise)
                    (wide ? too_wide : found).push_back(extremum);
            }
            for (double& value : curve) value = -value;
        }
    }
    // Light whose waves end at hogels is nowhere sharper than they are.
    return found.empty() ? too_wide : found;
}

// Whether two extrema are of one plane: their surroundings overlap.
bool same_plane(const Extremum& a, const Extremum& b) { return a.first <= b.last && b.first <= a.last; }

}  // namespace

double height_of(const Contrasts& contrast, std::size_t scale) { return std::log(contrast[scale] + 1e-9); }

std::vector<Extremum> planes_among(std::span<const Contrasts> contrasts, double step, double light_depth) {
    std::vector<Extremum> extrema = extrema_of(contrasts, step, light_depth);
    std::ranges::stable_sort(extrema, std::greater(), &Extremum::slope);
    std::vector<Extremum> planes, best;
    for (const Extremum& extremum : extrema) {
        // The rise between two planes of lowest contrast, or beside one, is no plane.
        if (std::ranges::any_of(best, [&](const Extremum& b) {
                return b.maximum != extremum.maximum && extremum.base >= b.first && extremum.base <= b.last;
            }))
            continue;
        const auto same = std::ranges::find_if(best, [&](const Extremum& b) { return same_plane(b, extremum); });
        if (same == best.end()) {
            best.push_back(extremum);
            planes.push_back(extremum);
            continue;
        }
        Extremum& plane = planes[static_cast<std::size_t>(same - best.begin())];
        const bool inside = extremum.index >= same->first && extremum.index <= same->last;
        if (inside && extremum.scale < plane.scale && extremum.prominence > 0.25 * same->prominence) {
            const double slope = plane.slope;
            plane = extremum;
            plane.slope = slope;
        }
    }
    return planes;
}

}  // namespace hogel::optics
