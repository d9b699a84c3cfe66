// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::baselines {

/// Returns the renderer with an ordinary depth buffer for each hogel. Every triangle is projected into the (U, V)
/// picture of the hogel and scan converted with edge functions. In the homogeneous form of docs/notation.md, section 2,
/// visibility needs no division by ζ, so triangles may cross the hologram plane and need no clipping.
RendererInfo zbuffer_renderer();

}  // namespace hogel::render::baselines
