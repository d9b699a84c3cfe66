// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/progress.h"
#include "hogel/scene.h"

namespace hogel::showpieces {

// Return the scenes that are not analytic. All functions take the side of the hologram in metres.
Scene make_pumpkin(double hologram_size);
Scene make_tower(double hologram_size);
Scene make_church(double hologram_size);
Scene make_chandelier(double hologram_size);
Scene make_billiards(double hologram_size);

// Returns the church with its global solution of light, in 3.4 million triangles: [K] fig. 5.27.
Scene make_church_radiance(double hologram_size, const Progress& progress);

}  // namespace hogel::showpieces
