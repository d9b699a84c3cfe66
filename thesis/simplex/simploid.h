// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::simplex {

/// The four-dimensional depth buffer without simplices (future work in [K] 7.2.2): the simploid that a triangle sweeps
/// out is sliced directly, first at each V, then at each t; each slice is a band in the plane (s, U), which is scan
/// converted. The result equals that of `simplex`. Memory in addition to the tile: 8 bytes for each ray of one V of the
/// tile.
RendererInfo simploid_renderer();

}  // namespace hogel::simplex
