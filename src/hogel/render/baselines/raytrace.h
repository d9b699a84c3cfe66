// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::baselines {

/// One ray a sample, traced by Embree from in front of the whole scene, so that scenes on both sides of the hologram
/// plane need no special care.
RendererInfo raytrace_renderer();

}  // namespace hogel::render::baselines
