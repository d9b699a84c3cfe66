// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/array.h"
#include "hogel/exchange/parallax.h"
#include "hogel/exchange/view_set.h"

namespace hogel::exchange {

/// How things move from one view to another across the line of the two cameras, which they do not in rectified views:
/// pixels at the rim of the picture, of the fit a + b x + c y + d x y with x and y from -1 to 1.
struct CrossParallax {
    double shift = 0;      ///< a
    double roll = 0;       ///< the coefficient of the coordinate along the line
    double zoom = 0;       ///< that of the other one
    double keystone = 0;   ///< d, which cameras have that are turned against each other
    double deviation = 0;  ///< median of what is left
    /// How far blocks reach along the line, across it, and to the corners: the 95th percentiles of |x|, |y| and |x y|.
    double along = 0, across = 0, corner = 0;
    std::size_t blocks = 0;  ///< that were compared; 0: too few with texture to say anything
};

/// @param along_y    whether the cameras stand above each other
/// @param max_shift  pixels that are searched along the line
CrossParallax cross_parallax(View<const float, 2> a, View<const float, 2> b, bool along_y, int max_shift);

/// Compares views in the middle row and column of a set. Throws Error(bad_input), naming two of the files, where their
/// pictures are keystoned by more than half a pixel, as those of cameras with toe-in are; notes other disagreement.
void require_rectified(ViewSet& set, const ParallaxEvidence& evidence);

}  // namespace hogel::exchange
