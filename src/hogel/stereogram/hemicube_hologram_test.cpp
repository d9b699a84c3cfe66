// SPDX-License-Identifier: Apache-2.0
// Holograms of hemicubes.
#include <gtest/gtest.h>

#include <cmath>

#include "hogel/hologram.h"
#include "hogel/photograph.h"
#include "hogel/stereogram/frequency_grid.h"
#include "hogel/stereogram/test_light_fields.h"
#include "hogel/units.h"

namespace hogel::stereogram {
namespace {

using namespace literals;

// A small luminous ball, seen 55 degrees off the axis, outside the front face: on the right, seen from the left.
TEST(HemicubeHologram, shows_a_ball_at_55_degrees_where_geometry_says) {
    const LightFieldGrid grid{16, 12, 36_um, 64, 64, Perspective{1, 1}, 1};
    for (const double side : {1.0, -1.0}) {
        const double angle = side * 55_deg;
        const Vec3 ball{2_mm * std::sin(angle), 0.2_mm, 2_mm * std::cos(angle)};
        const LightField light = hemicube_of(grid, [&](Vec3 hogel, Vec3 direction) {
            const Vec3 to = ball - hogel;
            const double along = dot(to, direction) / dot(direction, direction);
            return along > 0 && length(to - along * direction) < 90_um ? 1.0 : 0.0;
        });
        HologramOptions options;
        options.pitch = 0.36_um;
        options.looks = 4;
        const auto hologram = make_hologram(light, options);
        Camera camera;
        camera.eye = {-100_mm * std::sin(angle), -10_mm, 100_mm * std::cos(angle)};
        camera.pupil = 3_mm;
        camera.focus_depth = ball.z;
        camera.picture = {48, 36, 12_um, 12_um, 0, 0};
        const Spot waves = spot_of(photograph(*hologram, std::span(&camera, 1))[0], camera.picture);
        const Spot rays = spot_of(photograph(light, std::span(&camera, 1))[0], camera.picture);
        EXPECT_NEAR(waves.x, rays.x, 15_um);
        EXPECT_NEAR(waves.y, rays.y, 15_um);
        // Wider by the diffraction of a hogel, λζ/d, seen from the side.
        EXPECT_LT(waves.wide, 1.5 * rays.wide);
        // Where the line from the viewpoint to the ball crosses the hologram.
        const double share = camera.eye.z / (camera.eye.z + ball.z);
        EXPECT_NEAR(waves.x, camera.eye.x + share * (ball.x - camera.eye.x), 20_um);
        EXPECT_NEAR(waves.y, camera.eye.y + share * (ball.y - camera.eye.y), 20_um);
    }
}

TEST(HemicubeHologram, uniform_light_is_as_bright_from_all_sides_and_where_faces_meet) {
    const LightFieldGrid grid{14, 14, 36_um, 32, 32, Perspective{1, 1}, 1};
    const LightField light = hemicube_of(grid, [](Vec3, Vec3) { return 0.5; });
    HologramOptions options;
    options.pitch = 0.36_um;
    options.looks = 6;
    const auto hologram = make_hologram(light, options);
    for (const Vec3 towards : {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{-0.3, 1, 1}, Vec3{0, -1.3, 1}}) {
        Camera camera;
        camera.eye = 100_mm * normalize(towards);
        camera.pupil = 5_mm;
        camera.picture = {12, 12, 36_um, 36_um, 0, 0};
        EXPECT_NEAR(mean_of(photograph(*hologram, std::span(&camera, 1))[0]), 0.5, 0.025) << towards.x << towards.y;
    }
}

TEST(HemicubeHologram, has_the_moduli_of_its_front_within_the_front) {
    const LightFieldGrid grid{1, 1, 36_um, 48, 48, Perspective{1, 1}, 1};
    const std::vector<LightFieldGrid> faces = hemicube(grid);
    const FrequencyGrid front(faces.front(), 64, 633_nm), all(faces, 64, 633_nm);
    std::vector<float> radiance(all.rays()), a(std::size_t{64} * 64), b(a.size());
    for (std::size_t l = 0; l < 48; ++l)
        for (std::size_t k = 0; k < 48; ++k)
            radiance[l * 48 + k] = float(2 + std::sin(2 * grid.u(double(k))) * grid.v(double(l)));
    front.amplitudes(std::span(radiance).first(std::size_t{48} * 48), a);
    all.amplitudes(radiance, b);
    // Compares lobes well within the front, because the front's own code approximates a lobe by a rectangle in U and V.
    for (int j = -20; j <= 20; ++j)
        for (int i = -20; i <= 20; ++i) {
            const std::size_t at = std::size_t((64 - j) % 64) * 64 + std::size_t((64 + i) % 64);
            EXPECT_NEAR(b[at] / a[at], 1, 2e-3) << i << " " << j;
        }
}

}  // namespace
}  // namespace hogel::stereogram
