// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::baselines {

/// Returns the renderer for multiple viewpoint rendering. For each row of hogels, triangles are cut into slices, one
/// for each row V of directions, collected in slice tables. Then for each V the tracks of the slices in (s, U) are scan
/// converted with a depth buffer of (s, U). A slice is cut in the scene, where the plane of all rays of one t and one V
/// is y = t + Vζ, so the scene may lie on both sides of the hologram plane.
/// Memory in addition to the tile: 8 bytes for each ray of one row of directions of one row of hogels, and 88 bytes for
/// each slice of one row of hogels; a triangle may have n_V slices.
/// Source: [K] 5.2.3, fig. 5.8, after Halle. Differs: [K] interpolates slices between perspective views from the first
/// and the last s of a row, which need ζ > 0.
RendererInfo mvr_renderer();

}  // namespace hogel::render::baselines
