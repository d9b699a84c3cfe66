// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::baselines {

/// Renders, for each direction (U, V), one picture over the hogels of a tile: an oblique parallel projection, in which
/// triangles are scan converted with a depth buffer of (s, t). There is no division by ζ, so a scene may be on both
/// sides of the hologram plane. Memory in addition to the tile: 8 bytes for each of its hogels. Source: [K] 5.2.2, fig.
/// 5.6b, after Lucente.
RendererInfo oblique_renderer();

}  // namespace hogel::render::baselines
