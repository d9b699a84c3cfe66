// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/array.h"
#include "hogel/exchange/view_set.h"

/// How far things move from one view to another, by comparing blocks of pixels.
namespace hogel::exchange {

/// Where a block of one picture is in another, along one axis.
struct BlockMatch {
    double shift = 0;    ///< pixels, to the right or down
    double error = 0;    ///< sum of squared differences there
    double texture = 0;  ///< how much larger that sum is one pixel aside: 0 for blocks that look alike everywhere
};

/// Matches blocks of 16x16 pixels of `a` in `b`, [row of blocks][column], within max_shift pixels along x, or along y.
Array<BlockMatch, 2> match_blocks(View<const float, 2> a, View<const float, 2> b, bool along_y, int max_shift);

/// Parallax that is looked for, in pixels.
constexpr int max_parallax = 32;

/// Whether blocks with texture clearly move the other way in one of two comparisons of views than in the other.
bool move_oppositely(const Array<BlockMatch, 2>& a, const Array<BlockMatch, 2>& b);

/// Whether they clearly move the same way in both, and are found as well in the second as in the first.
bool move_alike(const Array<BlockMatch, 2>& a, const Array<BlockMatch, 2>& b);

/// Whether things clearly move up and down from one view to another, rather than sideways.
bool moves_up_and_down(View<const float, 2> a, View<const float, 2> b);

/// Mean of the channels of a view, as stored, in units of the full range.
Array<float, 2> grey_view(const ViewSet& set, std::size_t row, std::size_t column);

/// What the middle view and its neighbours say of the order of views.
struct ParallaxEvidence {
    double across = 0, down = 0;  ///< the 98th percentile of |shift| from a view to the next of its row, of its column
    bool swapped = false;         ///< rows are columns: along a row of views things move up and down
    bool opposed = false;  ///< across and down disagree: what moves left along a row moves down along a column of views
    bool certain = false;  ///< there is enough texture and parallax for the last two
};
/// @param disparity  that is taken off: pixels to the left per view to the right (ViewImportOptions::disparity)
ParallaxEvidence parallax_of(const ViewSet& set, double disparity = 0);

}  // namespace hogel::exchange
