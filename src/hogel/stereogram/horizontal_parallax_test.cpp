// SPDX-License-Identifier: Apache-2.0
// Holograms with horizontal parallax only, made of lines.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "hogel/hologram.h"
#include "hogel/photograph.h"
#include "hogel/stereogram/test_light_fields.h"
#include "hogel/units.h"

namespace hogel::stereogram {
namespace {

using namespace literals;

// A small square behind the hologram appears at its geometric position seen from the side, at its own height seen from
// above. x is in focus at the square's depth, y on the hologram.
TEST(HorizontalParallax, focuses_across_at_the_depth_of_things_and_up_and_down_on_the_hologram) {
    const double depth = 8_mm, half = 64_um;
    const LightFieldGrid grid{24, 24, 64_um, 64, 1, Perspective{0.15, 0.01}, 1};
    const LightField light = light_field_of_faces({&grid, 1}, [&](Vec3 hogel, Vec3 direction) {
        const double x = hogel.x + depth * direction.x / direction.z;
        return std::abs(x) < half && std::abs(hogel.y) < half ? 1.0 : 0.0;
    });
    HologramOptions options;
    options.pitch = 2_um;
    options.method = Lines{4_um};
    options.looks = 4;
    const auto hologram = make_hologram(light, options);
    const Grid& plane = hologram->grid().plane;
    ASSERT_EQ(plane.width, 768u);
    ASSERT_EQ(plane.height, 384u);
    EXPECT_NEAR(plane.pitch_y, 4_um, 1e-12);
    Camera camera;
    camera.pupil = 6_mm;
    camera.picture = {64, 64, 12_um, 12_um, 0, 0};
    const auto seen = [&](double eye_x, double eye_y, double focus) {
        camera.eye = {eye_x, eye_y, 100_mm};
        camera.focus_depth = focus;
        return spot_of(photograph(*hologram, std::span(&camera, 1))[0], camera.picture);
    };
    const double sharp = 2 * half / std::sqrt(12.0);
    // A disc of diameter A has a standard deviation of A/4; out of focus by ζ its width is A ζ/(R + ζ).
    const double blurred = std::hypot(sharp, 6_mm / 4 * depth / (100_mm + depth));
    const Spot far = seen(0, 0, depth), near = seen(0, 0, 0);
    EXPECT_NEAR(far.high, blurred, 0.15 * blurred);
    EXPECT_NEAR(near.wide, blurred, 0.15 * blurred);
    EXPECT_NEAR(near.high, sharp, 0.3 * sharp);
    // Horizontally a hogel is a slit, which diffracts to a width of λζ/d.
    EXPECT_LT(far.wide, 0.7 * blurred);
    // From the side and from above.
    const double aside = 2_mm, above = 1_mm;
    EXPECT_NEAR(seen(aside, 0, depth).x, aside * depth / (100_mm + depth), 15_um);
    EXPECT_NEAR(seen(0, above, 0).y, 0, 6_um);
}

// A ball on a side of a hemisquare: horizontally at its position, vertically at its height, as wide as a hogel
// diffracts.
TEST(HorizontalParallax, shows_a_ball_at_50_degrees_from_a_hemisquares_side) {
    const LightFieldGrid grid{16, 12, 36_um, 64, 1, Perspective{1, 0.1}, 1};
    for (const double side : {1.0, -1.0}) {
        const double angle = side * 50_deg;
        const Vec3 ball{2_mm * std::sin(angle), 72_um, 2_mm * std::cos(angle)};
        const LightField light = hemicube_of(grid, [&](Vec3 hogel, Vec3 direction) {
            const Vec3 to = ball - hogel, flat{to.x, 0, to.z};
            const double along = dot(flat, direction) / dot(direction, direction);
            return along > 0 && length(flat - along * direction) < 90_um && std::abs(to.y) < 90_um ? 1.0 : 0.0;
        });
        ASSERT_EQ(light.faces().size(), 3u);
        HologramOptions options;
        options.pitch = 0.36_um;
        options.method = Lines{4_um};
        options.looks = 4;
        const auto hologram = make_hologram(light, options);
        Camera camera;
        camera.eye = {-100_mm * std::sin(angle), 0, 100_mm * std::cos(angle)};
        camera.pupil = 3_mm;
        camera.focus_depth = ball.z;
        camera.picture = {48, 36, 12_um, 12_um, 0, 0};
        const Spot seen = spot_of(photograph(*hologram, std::span(&camera, 1))[0], camera.picture);
        const double share = camera.eye.z / (camera.eye.z + ball.z);
        EXPECT_NEAR(seen.x, camera.eye.x + share * (ball.x - camera.eye.x), 20_um);
        EXPECT_NEAR(seen.y, ball.y, 12_um);
        const double wide = 2 * 90_um / std::cos(angle) / std::sqrt(12.0);
        EXPECT_NEAR(seen.wide, wide, 0.35 * wide);
    }
    const LightField even = hemicube_of(grid, [](Vec3, Vec3) { return 0.5; });
    HologramOptions options;
    options.pitch = 0.36_um;
    options.method = Lines{4_um};
    options.looks = 24;  // the picture has about 170 resolution cells
    const auto hologram = make_hologram(even, options);
    for (const double angle : {0_deg, 45_deg, -55_deg}) {
        Camera camera;
        camera.eye = {100_mm * std::sin(angle), 0, 100_mm * std::cos(angle)};
        camera.pupil = 3_mm;
        camera.picture = {10, 10, 36_um, 36_um, 0, 0};
        EXPECT_NEAR(mean_of(photograph(*hologram, std::span(&camera, 1))[0]), 0.5, 0.04) << angle;
    }
}

TEST(HorizontalParallax, is_as_bright_as_the_light_field_for_every_line_pitch) {
    const LightFieldGrid grid{8, 8, 160_um, 30, 1, Perspective{0.12, 0.01}, 1};
    const LightField light = light_field_of_faces({&grid, 1}, [](Vec3, Vec3) { return 0.7; });
    for (const auto& [line_pitch, phases] : {std::pair{4_um, Phases::random},
                                             {10_um, Phases::random},
                                             {10_um, Phases::fixed},
                                             {10_um, Phases::designed}}) {
        HologramOptions options;
        options.pitch = 2_um;
        options.method = Lines{line_pitch, phases};
        options.looks = 6;
        Camera camera;
        camera.eye = {5_mm, 0, 100_mm};
        camera.pupil = 2.5_mm;  // equal hogels send light in directions λ/d apart, 0.4 mm there
        camera.picture = {8, 8, 100_um, 100_um, 0, 0};
        const auto hologram = make_hologram(light, options);
        EXPECT_NEAR(mean_of(photograph(*hologram, std::span(&camera, 1))[0]), 0.7, 0.04) << line_pitch;
    }
}

// Shared phases make the fringe of each line flat; the individual phase of each line spreads the light vertically.
TEST(HorizontalParallax, designed_phases_flatten_the_fringe_of_every_line) {
    const LightFieldGrid grid{8, 8, 160_um, 30, 1, Perspective{0.12, 0.01}, 1};
    const LightField light = light_field_of_faces({&grid, 1}, [](Vec3, Vec3) { return 0.7; });
    HologramOptions options;
    options.pitch = 2_um;
    const auto peak = [&](Phases phases) {
        options.method = Lines{10_um, phases};
        const auto hologram = make_hologram(light, options);
        Field field(hologram->grid());
        copy(*hologram, field);
        double largest = 0, sum = 0;
        for (const std::complex<float> value : field.samples.elements()) {
            largest = std::max<double>(largest, std::norm(value));
            sum += std::norm(value);
        }
        return largest * static_cast<double>(field.samples.size()) / sum;
    };
    EXPECT_GT(peak(Phases::random), 6);
    EXPECT_LT(peak(Phases::designed), 2.5);
    options.method = Lines{10_um, Phases::designed};
    Camera above;
    above.eye = {0, 1.5_mm, 100_mm};
    above.pupil = 2.5_mm;
    above.picture = {8, 8, 100_um, 100_um, 0, 0};
    options.looks = 6;
    EXPECT_NEAR(mean_of(photograph(*make_hologram(light, options), std::span(&above, 1))[0]), 0.7, 0.05);
}

}  // namespace
}  // namespace hogel::stereogram
