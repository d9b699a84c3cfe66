// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::simplex {

/// `simplex` with one dimension less, for light fields of one row of hogels (horizontal parallax only) or for one row
/// after the other: a triangle seen from a row of hogels sweeps out a (2,1)-simploid in (S, U, V), three tetrahedra.
/// Memory: 8 bytes for each ray of one row of hogels of the tile, besides the tile itself.
/// Throws Error(usage) for a scene that is not wholly behind the hologram plane. What is nearer to the plane than a
/// millionth of the scene's size is cut off.
/// Source: [K] 5.8 ("3D"), fig. 5.17c.
RendererInfo simplex3d_renderer();

}  // namespace hogel::render::simplex
