// SPDX-License-Identifier: Apache-2.0
#include "hogel/requests.h"

namespace hogel {

void BakeParameters::declare(Parameters& parameters) {
    parameters.count("--rays", options.rays, "From every vertex, for reflected light");
    parameters.count("--bounces", options.bounces, "How often light is reflected");
    parameters.count("--tessellate", options.tessellation, "Parts into which the sides of triangles are cut");
    parameters.positive_length("--size", place.size, "Width of the hologram that the scene is fitted to");
    place.scene.declare(parameters);
}

}  // namespace hogel
