// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "hogel/renderer.h"

namespace hogel::render {

/// Returns the scene that shows in common directions u the same as `scene` in directions u − s/depth through a fixed
/// focal plane (docs/notation.md, section 1). Each point (x, y, ζ) is divided by w = 1 − ζ/depth; the light is that of
/// `scene`. Rays and planes stay straight. While w > 0, the order of ζ along a ray is kept.
/// Throws Error(usage) naming `renderer` if a triangle reaches the focal plane.
/// @param grid  with the focal plane
std::shared_ptr<const ShadedScene> projected_scene(const std::shared_ptr<const ShadedScene>& scene,
                                                   const LightFieldGrid& grid, const std::string& renderer);

/// Returns the grid for rendering the projected scene: u and v of `grid` as directions of all hogels.
LightFieldGrid projected_grid(const LightFieldGrid& grid);

/// Returns the renderer of a grid with a fixed focal plane, made from a renderer of the projected scene and grid.
/// @param needs  name of the renderer in the error about a scene that reaches the plane
std::unique_ptr<Renderer> unprojected(std::unique_ptr<Renderer> projected, const LightFieldGrid& grid,
                                      std::string needs);

}  // namespace hogel::render
