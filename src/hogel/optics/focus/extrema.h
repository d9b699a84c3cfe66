// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "hogel/focus.h"

namespace hogel::optics {

using Contrasts = FocusSearch::Contrasts;

/// Returns the logarithm of a contrast, so that extrema are compared by ratios.
double height_of(const Contrasts& contrast, std::size_t scale);

/// An extremum of log contrast over depth at one scale.
struct Extremum {
    std::size_t index = 0, scale = 0;
    bool maximum = true;
    double prominence = 0;            ///< descent (ascent) needed to reach a higher (lower) sample
    std::size_t base = 0;             ///< index of the adjacent extremum of the other kind that is nearer in height
    std::size_t first = 0, last = 0;  ///< range of depths near the extremum
    std::size_t begin = 0, end = 0;   ///< range of depths within drop() of the extremum
    double slope = 0;                 ///< prominence per depth of focus

    /// Returns the height below the top at which the centre is measured. It is deep enough to average ripple, and
    /// shallow enough to separate peaks of great prominence from their neighbours.
    double drop() const { return std::min(prominence / 2, 1.0); }
};

/// Returns the extrema that are planes in focus, in decreasing order of slope.
/// @param step         distance of adjacent depths, in depths of focus of the samples
/// @param light_depth  depth of focus of the light, in depths of focus of the samples
std::vector<Extremum> planes_among(std::span<const Contrasts> contrasts, double step, double light_depth);

}  // namespace hogel::optics
