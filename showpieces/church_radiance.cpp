// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading.h"
#include "showpieces/showpieces.h"

namespace hogel::showpieces {

Scene make_church_radiance(double hologram_size, const Progress& progress) {
    return bake_scene(make_church(hologram_size), {.rays = 96, .bounces = 4, .tessellation = 6}, progress);
}

}  // namespace hogel::showpieces
