// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "hogel/focus.h"

namespace hogel::optics {

using Contrasts = FocusSearch::Contrasts;

/// The height in which extrema are looked for: the logarithm of the contrast, so that ratios count.
double height_of(const Contrasts& contrast, std::size_t scale);

/// An extremum of one scale's curve of heights.
struct Extremum {
    std::size_t index = 0, scale = 0;
    bool maximum = true;
    double prominence = 0;            ///< how far one must go down (or up) to reach another that is higher (or lower)
    std::size_t base = 0;             ///< the nearer of the two extrema of the other kind beside it
    std::size_t first = 0, last = 0;  ///< where the curve is near the extremum
    std::size_t begin = 0, end = 0;   ///< where it has gone by less than drop()
    double slope = 0;                 ///< prominence for each depth of focus

    /// How far below the top the curve still tells where the middle is: deep enough to even out ripple, and not so deep
    /// that peaks of great prominence reach to others.
    double drop() const { return std::min(prominence / 2, 1.0); }
};

/// The extrema that are planes in focus, the steepest first.
/// @param step         between neighbouring depths, in depths of focus of the samples
/// @param light_depth  the depth of focus of the light, likewise
std::vector<Extremum> planes_among(std::span<const Contrasts> contrasts, double step, double light_depth);

}  // namespace hogel::optics
