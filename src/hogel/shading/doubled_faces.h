// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/shading.h"

namespace hogel::shading {

/// Removes duplicates of triangles with the same three corner positions, so that no ray meets two at one depth and all
/// renderers give the same result. Keeps the first triangle with its front to the middle of the hologram, else the
/// first. With ShadedScene::fronts_only keeps one of each winding, because a ray sees only one of them. The order of
/// the others is kept. Time: one hash table lookup per triangle.
void keep_one_of_doubled_faces(ShadedScene& scene);

}  // namespace hogel::shading
