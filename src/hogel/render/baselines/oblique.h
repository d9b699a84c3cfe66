// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::render::baselines {

/// For each direction (U, V) one picture over the hogels of a tile, an oblique parallel projection in which triangles
/// are scan converted with a depth buffer of (s, t). Nothing is divided by ζ, so a scene may be on both sides of the
/// hologram plane. Memory: 8 bytes for each hogel of the tile, besides the tile itself.
/// Source: [K] 5.2.2, fig. 5.6b, after Lucente.
std::unique_ptr<LightFieldSource> make_oblique_renderer(std::shared_ptr<const ShadedScene> scene,
                                                        const LightFieldGrid& grid);

}  // namespace hogel::render::baselines
