// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::baselines {

/// Returns the renderer that traces one ray per sample with Embree. Rays begin in front of the whole scene, so scenes
/// on both sides of the hologram plane need no special treatment.
RendererInfo raytrace_renderer();

}  // namespace hogel::render::baselines
