// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::baselines {

/// Returns the renderer that draws one picture over the hogels of a tile for each direction (U, V): an oblique parallel
/// projection with a depth buffer of (s, t). There is no division by ζ, so a scene may be on both sides of the hologram
/// plane. Memory in addition to the tile: 8 bytes for each of its hogels. Source: [K] 5.2.2, fig. 5.6b, after Lucente.
RendererInfo oblique_renderer();

}  // namespace hogel::render::baselines
