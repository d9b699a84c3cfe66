// SPDX-License-Identifier: Apache-2.0
#include "hogel/requests.h"

namespace hogel {

void BakeParameters::declare(Parameters& parameters) {
    parameters.count("--rays", options.rays, "Number of rays from every vertex, for reflected light");
    parameters.count("--bounces", options.bounces, "Number of reflections of light");
    parameters.count("--tessellate", options.tessellation,
                     "Number of parts into which each side of a triangle is divided");
    parameters.positive_length("--size", place.size, "Width of the hologram to which the scene is fitted");
    place.scene.declare(parameters);
}

}  // namespace hogel
