// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::epi {

/// Returns the renderer that works in epipolar order (docs/notation.md, section 2). For each row t of hogels and each
/// row V of directions, the plane y = t + Vζ cuts every triangle in a segment. The segment covers a span, a thin band,
/// in the plane of (s, U). A span is set up once for all hogels of its row, so tiles should be whole rows of hogels.
RendererInfo epi_renderer();

}  // namespace hogel::render::epi
