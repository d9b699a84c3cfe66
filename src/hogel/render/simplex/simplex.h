// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::simplex {

/// The four-dimensional depth buffer: a triangle is projected once from the whole (s, t) range of a tile, and the
/// polyhedron that it sweeps out in (S, T, U, V) is cut down to samples. The larger the tile, the more hogels share
/// that work. Memory: 8 bytes for each ray of the tile, besides the tile itself.
/// Throws Error(usage) for a scene that is not wholly behind the hologram plane. What is nearer to the plane than a
/// millionth of the scene's size is cut off.
/// Source: [K] 5.3 to 5.7. Differs: front and back faces are both seen, and what a ray sees of a triangle is computed
/// from the ray and the triangle (oblique_triangle.h), not interpolated between the corners of simplices, so that
/// values do not depend on the range. Shading is done once per ray, at the end.
RendererInfo simplex_renderer();

}  // namespace hogel::render::simplex
