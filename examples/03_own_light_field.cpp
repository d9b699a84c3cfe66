// SPDX-License-Identifier: Apache-2.0
// Defines a light field by a function of the ray, writes it to a file, and photographs it by rays.
#include <cmath>
#include <cstdio>

#include "hogel/hogel.h"

using namespace hogel;
using namespace hogel::literals;

int main() {
    const LightFieldGrid grid{80, 80, 50_um, 24, 24, field_of_view(14_deg), 1};
    // A picture on a plane behind the hologram. The function must be thread-safe.
    constexpr double depth = 8_mm;
    const LightField rings = light_field_from(grid, [=](double s, double t, double u, double v) {
        return 0.5 + 0.5 * std::cos(9e3 * std::hypot(s + u * depth, t + v * depth));
    });
    write_light_field("rings.h5", rings, {});

    const LightField from_file = open_light_field("rings.h5");  // a light field like any other
    Camera camera = camera_for(grid.width(), grid.height(), 200);
    camera.focus_depth = depth;
    const Image picture = photograph(from_file, camera);
    write_image("rings.png", picture);
    std::printf("rings.h5: %zu hogels of %zu directions\n", grid.hogels(), grid.directions());
}
