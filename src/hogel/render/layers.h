// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/renderer.h"

namespace hogel::render {

/// Returns a renderer that draws the layers of a scene (ShadedScene::layers: masks and blended surfaces) over the
/// opaque triangles drawn by `opaque`. A scene without layers is rendered by `opaque` alone.
///
/// All renderers draw layers alike. For each ray, ObliqueTriangle finds the layers, opacity_at() their opacity. Layers
/// in front of the opaque surface are blended from front to back. The depth is that of the nearest surface with an
/// opacity of at least 0.5.
std::unique_ptr<Renderer> with_layers(std::unique_ptr<Renderer> opaque,
                                      const std::shared_ptr<const ShadedScene>& scene);

/// Returns the renderer of the opaque triangles in a renderer of with_layers(); returns any other renderer unchanged.
const LightFieldSource& without_layers(const LightFieldSource& renderer);

}  // namespace hogel::render
