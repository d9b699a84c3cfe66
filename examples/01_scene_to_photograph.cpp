// SPDX-License-Identifier: Apache-2.0
// Renders a scene as a light field, makes its hologram in three colours, and photographs it from the axis.
#include "hogel/hogel.h"

using namespace hogel;

int main() {
    LightFieldRequest request;
    request.grid = {96, 96, 50e-6, 32, 32, field_of_view(0.28)};  // hogels, their pitch, directions in each
    const LightField light_field = render_light_field(load_scene("pumpkin", request), request);
    const auto holograms = make_holograms(light_field, {.looks = 4});  // red, green and blue
    const Camera camera = camera_for(light_field.grid().width(), light_field.grid().height(), 200);
    const Image photograph = photograph_colours(holograms, camera);
    write_image("photograph.png", photograph, automatic_exposure(photograph));
}
