// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene.h"

namespace hogel::scene {

/// Cuts every triangle into n² congruent ones. Interpolates vertex attributes and normalises normals. Triangles that
/// share an edge share its new vertices. Throws Error(usage) for n = 0 and for a mesh with more than 2^32 vertices.
Scene tessellate(const Scene& scene, std::size_t n);

}  // namespace hogel::scene
