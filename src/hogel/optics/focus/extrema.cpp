// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/focus/extrema.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace hogel::optics {
namespace {

// Returns the noise of a curve: the 90th percentile of deviations from the mean of the neighbours. The upper tenth may
// be planes in focus.
double noise_of(const std::vector<double>& curve) {
    std::vector<double> deviations;
    for (std::size_t i = 1; i + 1 < curve.size(); ++i)
        deviations.push_back(std::abs(curve[i] - (curve[i - 1] + curve[i + 1]) / 2));
    const std::size_t percentile = deviations.size() * 9 / 10;
    std::ranges::nth_element(deviations, deviations.begin() + static_cast<std::ptrdiff_t>(percentile));
    return deviations[percentile];
}

// Returns the inner maxima of a curve and their prominences.
std::vector<Extremum> maxima_of(const std::vector<double>& curve) {
    std::vector<Extremum> maxima;
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
        // Half the prominence, at most 0.35 (a factor of 0.7 in contrast).
        const double threshold = curve[i] - std::min(extremum.prominence / 2, 0.35);
        for (extremum.first = i; extremum.first > 0 && curve[extremum.first - 1] >= threshold;) --extremum.first;
        for (extremum.last = i; extremum.last + 1 < n && curve[extremum.last + 1] >= threshold;) ++extremum.last;
        const double drop_level = curve[i] - extremum.drop();
        for (extremum.begin = i; extremum.begin > 0 && curve[extremum.begin - 1] >= drop_level;) --extremum.begin;
        for (extremum.end = i; extremum.end + 1 < n && curve[extremum.end + 1] >= drop_level;) ++extremum.end;
        maxima.push_back(extremum);
    }
    return maxima;
}

// Returns extrema of both kinds at all scales that exceed the noise and are no wider than defocus makes them. Defocus
// blurs a square of n samples in about n depths of focus, more if the light lacks some frequencies of the samples.
std::vector<Extremum> extrema_of(std::span<const Contrasts> contrasts, double step, double light_depth) {
    // Tuned on the fields of docs/holograms-from-elsewhere.md (docs/decisions/0085-planes-in-focus.md).
    constexpr double min_prominence = 0.08, min_noise_ratio = 4, max_width = 8;
    std::vector<Extremum> found, too_wide;
    for (std::size_t s = 0; s <= FocusSearch::edges; ++s) {
        std::vector<double> curve;
        for (const Contrasts& contrast : contrasts) curve.push_back(height_of(contrast, s));
        const double noise = noise_of(curve);
        // For light with few frequencies, edges are as wide as the largest squares.
        const std::size_t cell = FocusSearch::cells[std::min(s, FocusSearch::cells.size() - 1)];
        for (const bool maximum : {true, false}) {
            for (Extremum extremum : maxima_of(curve)) {
                extremum.scale = s;
                extremum.maximum = maximum;
                const double width =
                    static_cast<double>(std::max<std::size_t>(extremum.last - extremum.first, 1)) * step / 2;
                extremum.slope = extremum.prominence / width;
                const bool is_wide = width > max_width * std::max(static_cast<double>(cell), light_depth);
                if (s == FocusSearch::edges && !maximum) continue;
                if (extremum.prominence > min_prominence && extremum.prominence > min_noise_ratio * noise)
                    (is_wide ? too_wide : found).push_back(extremum);
            }
            for (double& value : curve) value = -value;
        }
    }
    // Light whose waves end at hogel borders has no detail finer than hogels.
    return found.empty() ? too_wide : found;
}

// Returns whether two extrema belong to one plane: their ranges of depths overlap.
bool same_plane(const Extremum& a, const Extremum& b) { return a.first <= b.last && b.first <= a.last; }

}  // namespace

double height_of(const Contrasts& contrast, std::size_t scale) { return std::log(contrast[scale] + 1e-9); }

std::vector<Extremum> planes_among(std::span<const Contrasts> contrasts, double step, double light_depth) {
    std::vector<Extremum> extrema = extrema_of(contrasts, step, light_depth);
    std::ranges::stable_sort(extrema, std::greater(), &Extremum::slope);
    std::vector<Extremum> planes, best;
    for (const Extremum& extremum : extrema) {
        // An extremum between two planes of lowest contrast, or beside one, is no plane.
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
