// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/shading.h"

namespace hogel::shading {

/// Sets the alphas of vertices and meshes of a scene with geometry; clears them if every surface is opaque. A mesh with
/// a mask or blending counts as opaque if its alpha is high everywhere.
void set_alphas(const Scene& scene, ShadedScene& shaded);

/// Moves the triangles that are not opaque, and the alphas, to ShadedScene::layers.
void separate_layers(ShadedScene& shaded);

}  // namespace hogel::shading
