// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/shading.h"

namespace hogel::shading {

/// Keeps one of the triangles with the same three corner positions, so that no ray meets two at one depth and every
/// renderer shows the same. It is the first whose front faces the middle of the hologram, or else the first. With
/// ShadedScene::fronts_only one is kept of each winding, because a ray sees one of them. The order of the others
/// stays. Time: one look at each triangle in a hash table.
void keep_one_of_doubled_faces(ShadedScene& scene);

}  // namespace hogel::shading
