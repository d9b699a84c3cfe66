// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "hogel/coding/histogram_rule.h"
#include "hogel/compress.h"

namespace hogel::codec {

// A coder of coefficients for which [K]'s rule predicts sizes.
class CountsMagnitudes {
  public:
    virtual ~CountsMagnitudes() = default;
    // Counts the coefficients of all channels of a tile.
    // @param tile   its radiance is overwritten
    virtual coding::MagnitudeHistogram magnitudes(LightFieldTile& tile) const = 0;
};

// The coder of a light field's tiles: a row of coders(), or one of the two that a stream may name beside them,
// "lossless" and "bounded".
// @param counted   the directions whose errors count
// Throws Error(usage) for a coder or transform that does not exist, or two that do not go together.
std::unique_ptr<TileCoder> make_tile_coder(const CodingMethod& method, const LightFieldGrid& grid,
                                           const DirectionCross& counted = {});

// The rows of coders() that reproduce [K] chapter 4: defined in thesis/zerotrees.
std::vector<CoderInfo> thesis_coders();

}  // namespace hogel::codec
