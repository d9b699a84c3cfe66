// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::epi {

/// The light field in epipolar order (docs/notation.md, section 2): for each row t of hogels and each row V of
/// directions, the plane y = t + Vζ cuts every triangle in a segment, and a segment is a thin strip in the plane (s,U).
/// What is set up once for a strip serves all hogels of the row, so tiles should be whole rows of hogels.
RendererInfo epi_renderer();

}  // namespace hogel::render::epi
