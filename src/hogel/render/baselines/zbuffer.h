// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::render::baselines {

/// An ordinary depth buffer for each hogel: every triangle is projected into the (U,V) picture of the hogel and scan
/// converted with edge functions. In the homogeneous form of docs/notation.md section 2 nothing is divided by ζ before
/// visibility is decided, so triangles may cross the hologram plane and need no clipping.
std::unique_ptr<LightFieldSource> make_zbuffer_renderer(std::shared_ptr<const ShadedScene> scene,
                                                        const LightFieldGrid& grid);

}  // namespace hogel::render::baselines
