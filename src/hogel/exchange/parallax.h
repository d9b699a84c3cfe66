// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/array.h"
#include "hogel/exchange/view_set.h"

/// Parallax between views, estimated by block matching.
namespace hogel::exchange {

/// Position of a block of one picture in another, along one axis.
struct BlockMatch {
    double shift = 0;    ///< pixels, to the right or down
    double error = 0;    ///< sum of squared differences at that shift
    double texture = 0;  ///< increase of that sum at a shift of one pixel; 0 for blocks without texture
};

/// Matches blocks of 16x16 pixels of `a` in `b`, [row of blocks][column], within max_shift pixels along x or y.
Array<BlockMatch, 2> match_blocks(View<const float, 2> a, View<const float, 2> b, bool along_y, int max_shift);

/// Search range of the parallax, pixels.
constexpr int max_parallax = 32;

/// Returns whether textured blocks clearly move in opposite directions in the two comparisons.
bool move_oppositely(const Array<BlockMatch, 2>& a, const Array<BlockMatch, 2>& b);

/// Returns whether textured blocks clearly move in the same direction in both comparisons, and match equally well.
bool move_alike(const Array<BlockMatch, 2>& a, const Array<BlockMatch, 2>& b);

/// Returns whether the parallax between two views is clearly vertical rather than horizontal.
bool moves_up_and_down(View<const float, 2> a, View<const float, 2> b);

/// Returns the mean of a view's channels as stored, [y][x], in units of the full range.
Array<float, 2> grey_view(const ViewSet& set, std::size_t row, std::size_t column);

/// Evidence about the order of views, from the middle view and its neighbours.
struct ParallaxEvidence {
    double across = 0, down = 0;  ///< 98th percentile of |shift| between neighbours in a row, in a column, pixels
    bool swapped = false;         ///< rows are columns: parallax along a row of views is vertical
    bool opposed = false;  ///< the signs of across and down disagree: the vertical or horizontal order is reversed
    bool certain = false;  ///< whether texture and parallax suffice for `swapped` and `opposed`
};
/// @param disparity  ViewImportOptions::disparity, pixels to the left per view to the right; subtracted
ParallaxEvidence parallax_of(const ViewSet& set, double disparity = 0);

}  // namespace hogel::exchange
