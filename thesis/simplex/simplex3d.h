// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::simplex {

/// `simplex` with one dimension less, for one row of hogels at a time: a triangle seen from a row of hogels sweeps out
/// a (2,1)-simploid in (S, U, V), three tetrahedra. Memory in addition to the tile: 8 bytes for each ray of one row of
/// hogels. Throws Error(usage) unless the scene is entirely behind the hologram plane. Parts nearer to the plane than a
/// millionth of the scene's size are clipped. Source: [K] 5.8 ("3D"), fig. 5.17c.
RendererInfo simplex3d_renderer();

}  // namespace hogel::simplex
