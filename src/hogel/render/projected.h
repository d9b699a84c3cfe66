// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "hogel/renderer.h"

namespace hogel::render {

/// The scene that shows in common directions u what `scene` shows in directions u − s/depth through a fixed focal plane
/// (docs/notation.md, section 1): each point (x, y, ζ) divided by w = 1 − ζ/depth, with the light of `scene`. Rays and
/// planes stay straight, and of the points of a ray those with the smaller ζ remain those, as long as w > 0.
/// Throws Error(usage), saying that `renderer` needs it, if a triangle reaches the focal plane.
/// @param grid  with the focal plane
std::shared_ptr<const ShadedScene> projected_scene(const std::shared_ptr<const ShadedScene>& scene,
                                                   const LightFieldGrid& grid, const std::string& renderer);

/// The grid in which the projected scene is rendered: the numbers u and v of `grid` as directions of all hogels.
LightFieldGrid projected_grid(const LightFieldGrid& grid);

/// The renderer of a grid with a fixed focal plane, made from one of the projected scene and grid. `needs` says which
/// renderer it is that needs a scene on one side of the plane.
std::unique_ptr<Renderer> unprojected(std::unique_ptr<Renderer> projected, const LightFieldGrid& grid,
                                      std::string needs);

}  // namespace hogel::render
