// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/shading.h"

namespace hogel::shading {

/// Gives a scene whose geometry is set the alphas of its vertices and meshes; none if every surface is opaque. A mesh
/// that has a mask or blends in name only, because alpha is high everywhere, counts as opaque.
void set_alphas(const Scene& scene, ShadedScene& shaded);

/// Moves the triangles that are not opaque, and the alphas, to ShadedScene::layers.
void separate_layers(ShadedScene& shaded);

}  // namespace hogel::shading
