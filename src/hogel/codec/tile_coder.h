// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "hogel/coding/histogram_rule.h"
#include "hogel/compress.h"

namespace hogel::codec {

// Coder with sizes that [K]'s rule predicts from a histogram of its coefficients.
class CountsMagnitudes {
  public:
    virtual ~CountsMagnitudes() = default;
    // Counts the coefficients of all channels of a tile.
    // @param tile   radiance is overwritten
    virtual coding::MagnitudeHistogram magnitudes(LightFieldTile& tile) const = 0;
};

// Returns the coder of a light field's tiles: a row of coders(), or "lossless" or "bounded", which a stream may also
// name. Throws Error(usage) for an unknown coder or transform, or an impossible combination.
// @param counted   directions included in the error
std::unique_ptr<TileCoder> make_tile_coder(const CodingMethod& method, const LightFieldGrid& grid,
                                           const DirectionCross& counted = {});

// Returns the rows of coders() that reproduce [K] chapter 4: defined in thesis/zerotrees.
std::vector<CoderInfo> thesis_coders();

}  // namespace hogel::codec
