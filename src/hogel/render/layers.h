// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/renderer.h"

namespace hogel::render {

/// A renderer that shows the layers of a scene (ShadedScene::layers: masks, and surfaces that blend) in front of what
/// another one shows of its opaque triangles. A scene without layers it shows as that renderer does.
///
/// Every renderer shows layers alike: for each ray they are found by ObliqueTriangle and kept if they are there
/// (opacity_at()) and nearer than what the other renderer found. From the nearest on, each gives its radiance times its
/// opacity times what those before it let through. The depth is that of the nearest surface that is at least half
/// opaque by itself.
std::unique_ptr<Renderer> with_layers(std::unique_ptr<Renderer> opaque,
                                      const std::shared_ptr<const ShadedScene>& scene);

/// What shows the opaque triangles in a renderer of with_layers(); any other renderer itself.
const LightFieldSource& without_layers(const LightFieldSource& renderer);

}  // namespace hogel::render
