// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::simplex {

/// The four-dimensional depth buffer. A triangle is projected once from the (s, t) range of a tile, and the polyhedron
/// that it sweeps out in (S, T, U, V) is sliced into samples. Larger tiles share this work among more hogels. Memory in
/// addition to the tile: 8 bytes for each of its rays. Throws Error(usage) unless the scene is entirely behind the
/// hologram plane. Parts nearer to the plane than a millionth of the scene's size are clipped. Source: [K] 5.3 to 5.7.
/// Differs: both front and back faces are visible, and samples are computed from the ray and the triangle
/// (oblique_triangle.h), not interpolated between the corners of simplices, so that values do not depend on the range.
/// Shading is done once per ray, at the end.
RendererInfo simplex_renderer();

/// `simplex` in strips of simplices that share corners and are sliced together: the first idea of [K] 7.2.2. Yields the
/// same samples.
RendererInfo simplex_strips_renderer();

}  // namespace hogel::simplex
