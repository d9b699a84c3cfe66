// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::render::baselines {

/// One ray a sample, traced through Embree from in front of the whole scene, so scenes on both sides of the hologram
/// plane need no special care.
std::unique_ptr<LightFieldSource> make_raytrace_renderer(std::shared_ptr<const ShadedScene> scene,
                                                         const LightFieldGrid& grid);

}  // namespace hogel::render::baselines
