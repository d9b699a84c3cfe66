// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/array.h"

namespace hogel::camera::speckle_free {

/// Spreads light as the rim of a pupil does, by the third power of the distance, over hogels that are farther away than
/// `reach` along an axis and nearer than `limit`, so that all of it arrives within the limit. Grids of more than 1024
/// hogels are computed in bins. Lengths are counted in hogels; the result has the shape of `light`, [row][column].
Array<float, 2> spread_tails(View<const float, 2> light, std::size_t reach, double limit);

/// The value of a smooth array at a place between its elements, linearly interpolated and constant beyond its rim.
float between(View<const float, 2> values, double row, double column);

}  // namespace hogel::camera::speckle_free
