// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/array.h"

namespace hogel::camera::speckle_free {

/// Spreads light like the diffraction at the rim of a pupil, by the third power of the distance, over hogels farther
/// than `inner_radius` along an axis and nearer than `outer_radius`, in hogels. All of it arrives within the outer
/// radius. Grids of more than 1024 hogels are computed in bins. The result has the shape of `light`, [row][column].
Array<float, 2> spread_tails(View<const float, 2> light, std::size_t inner_radius, double outer_radius);

/// Returns the value of a smooth array between its elements, linearly interpolated, and constant beyond its edge.
float interpolate(View<const float, 2> values, double row, double column);

}  // namespace hogel::camera::speckle_free
