// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/array.h"
#include "hogel/exchange/parallax.h"
#include "hogel/exchange/view_set.h"

namespace hogel::exchange {

/// Shift between two views perpendicular to the line of the cameras, 0 if rectified. Values are pixels at the edge of
/// the picture, of the fit a + b x + c y + d x y with x and y from -1 to 1.
struct CrossParallax {
    double shift = 0;      ///< a
    double roll = 0;       ///< coefficient of the coordinate along the line
    double zoom = 0;       ///< coefficient of the coordinate across the line
    double keystone = 0;   ///< d, not 0 for cameras that are rotated relative to each other
    double deviation = 0;  ///< median of the residual
    /// Extent of the blocks along, across, and towards the corners: 95th percentiles of |x|, |y|, |x y|.
    double along = 0, across = 0, corner = 0;
    std::size_t blocks = 0;  ///< number of compared blocks; 0 if too few have texture
};

/// Estimates the cross parallax of two views.
/// @param along_y    whether the cameras are one above the other
/// @param max_shift  search range along the line, pixels
CrossParallax cross_parallax(View<const float, 2> a, View<const float, 2> b, bool along_y, int max_shift);

/// Compares views in the middle row and column of a set. Throws Error(bad_input), naming two of the files, if a
/// keystone exceeds half a pixel, as with toe-in cameras. Adds a note for other disagreement.
void require_rectified(ViewSet& set, const ParallaxEvidence& evidence);

}  // namespace hogel::exchange
