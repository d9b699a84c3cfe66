// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::simplex {

/// The four-dimensional depth buffer without simplices ([K] 7.2.2, future work there): the simploid that a triangle
/// sweeps out is sliced whole, first at each V, then at each t; each slice is a band in the plane (s, U), which is scan
/// converted as it is. Gives what `simplex` gives. Memory: 8 bytes for each ray of one V of the tile, besides the tile
/// itself.
RendererInfo simploid_renderer();

}  // namespace hogel::render::simplex
