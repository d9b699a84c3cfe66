// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/renderer.h"

namespace hogel::render::baselines {

/// An ordinary depth buffer for each hogel: every triangle is projected into the (U, V) picture of the hogel and scan
/// converted with edge functions. In the homogeneous form of docs/notation.md, section 2, there is no division by ζ
/// before visibility is decided, so triangles may cross the hologram plane and need no clipping.
RendererInfo zbuffer_renderer();

}  // namespace hogel::render::baselines
