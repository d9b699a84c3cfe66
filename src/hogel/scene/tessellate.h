// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene.h"

namespace hogel::scene {

/// Cuts every triangle into n² congruent ones. Vertex attributes are interpolated, and normals made unit length again.
/// Triangles that share two vertices share the new ones between them. Throws Error(usage) for n = 0 and for a mesh that
/// would have more than 2^32 vertices.
Scene tessellate(const Scene& scene, std::size_t n);

}  // namespace hogel::scene
