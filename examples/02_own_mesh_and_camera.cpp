// SPDX-License-Identifier: Apache-2.0
// Makes a lit mesh and photographs its hologram from the side, focused behind the hologram plane.
#include <cstdio>

#include "hogel/hogel.h"

using namespace hogel;
using namespace hogel::literals;

// Returns an upright square that faces the viewer, `depth` metres behind the hologram.
Mesh square(double side, double depth, Rgb color) {
    const double a = side / 2;
    Mesh mesh;
    mesh.positions = {{-a, -a, -depth}, {a, -a, -depth}, {a, a, -depth}, {-a, a, -depth}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material.base_color = color;
    return mesh;
}

int main() {
    Scene scene;
    scene.meshes = {square(1_mm, 1_mm, {0.9f, 0.3f, 0.1f}), square(4_mm, 5_mm, {0.2f, 0.4f, 0.9f})};
    Light lamp;
    lamp.direction = normalize(Vec3{0.3, -0.5, -1});
    lamp.intensity = {3, 3, 3};
    scene.lights = {lamp};

    LightFieldRequest request;
    request.grid = {64, 64, 60_um, 32, 32, field_of_view(16_deg)};
    const LightField light_field = render_light_field(scene, request);
    const auto holograms = make_holograms(light_field, {.looks = 4});

    Camera camera = camera_for(light_field.grid().width(), light_field.grid().height(), 160);
    camera.eye = {12_mm, 5_mm, 300_mm};
    camera.focus_depth = 5_mm;  // on the large square
    camera.pupil = 5_mm;
    const Image photo = photograph_colours(holograms, camera);
    const Image reference = photograph(light_field, camera);  // by rays
    const double exposure = automatic_exposure(reference);
    write_image("squares.png", photo, exposure);
    std::printf("PSNR %.1f dB against geometric optics\n", compare(reference, photo, exposure).psnr);
}
