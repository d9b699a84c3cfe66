// SPDX-License-Identifier: Apache-2.0
// Laws of stereograms of all kinds of light fields: hemicubes, frequency grids, one row of directions.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "hogel/error.h"
#include "hogel/hologram.h"
#include "hogel/hologram/frequency_grid.h"
#include "hogel/photograph.h"
#include "hogel/ray_photograph.h"
#include "hogel/units.h"

namespace hogel::hologram {
namespace {

using namespace literals;
using Complex = std::complex<float>;
using Radiance = std::function<double(Vec3 hogel, Vec3 way)>;  // (x, y, ζ), the way of any length

LightFieldBuffer light_field_of(const LightFieldGrid& grid, const Radiance& radiance) {
    LightFieldBuffer light_field(grid);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t s = 0; s < grid.hogels_s; ++s)
            for (std::size_t l = 0; l < grid.directions_v; ++l)
                for (std::size_t k = 0; k < grid.directions_u; ++k)
                    light_field.radiance(0, t, s, l, k) =
                        float(radiance({grid.s(double(s)), grid.t(double(t)), 0},
                                       grid.direction_of(grid.u(double(k)), grid.v(double(l)))));
    return light_field;
}

struct Hemicube {
    std::vector<LightFieldBuffer> faces;
    std::vector<const LightFieldSource*> sources;

    Hemicube(const LightFieldGrid& grid, const Radiance& radiance) {
        for (const LightFieldGrid& face : hemicube(grid)) faces.push_back(light_field_of(face, radiance));
        for (const LightFieldBuffer& face : faces) sources.push_back(&face);
    }
};

struct Spot {
    double x = 0, y = 0, wide = 0, high = 0;  // middle and standard deviations, metres
};
Spot spot_of(const Image& image, const Grid& picture) {
    Spot spot;
    double all = 0;
    const auto sum = [&](auto&& add) {
        for (std::size_t row = 0; row < picture.height; ++row)
            for (std::size_t column = 0; column < picture.width; ++column)
                add(double(image.pixels(row, column, 0)), picture.x(double(column)), picture.y(double(row)));
    };
    sum([&](double light, double x, double y) { all += light, spot.x += light * x, spot.y += light * y; });
    spot.x /= all;
    spot.y /= all;
    sum([&](double light, double x, double y) {
        spot.wide += light * (x - spot.x) * (x - spot.x) / all;
        spot.high += light * (y - spot.y) * (y - spot.y) / all;
    });
    spot.wide = std::sqrt(spot.wide);
    spot.high = std::sqrt(spot.high);
    return spot;
}

double mean_of(const Image& image) {
    double mean = 0;
    for (const float value : image.pixels.elements()) mean += value / double(image.pixels.size());
    return mean;
}

// A small ball that shines, seen 55 degrees off the axis: beyond the front face. To the right, so on the left.
TEST(HemicubeStereogram, shows_a_point_at_55_degrees_where_geometry_says) {
    const LightFieldGrid grid{16, 12, 36_um, 64, 64, Perspective{1, 1}, 1};
    for (const double side : {1.0, -1.0}) {
        const double angle = side * 55_deg;
        const Vec3 ball{2_mm * std::sin(angle), 0.2_mm, 2_mm * std::cos(angle)};
        const Hemicube light(grid, [&](Vec3 hogel, Vec3 way) {
            const Vec3 to = ball - hogel;
            const double along = dot(to, way) / dot(way, way);
            return along > 0 && length(to - along * way) < 90_um ? 1.0 : 0.0;
        });
        HologramOptions options;
        options.pitch = 0.36_um;
        options.looks = 4;
        const auto hologram = make_hologram(light.sources, options);
        Camera camera;
        camera.eye = {-100_mm * std::sin(angle), -10_mm, 100_mm * std::cos(angle)};
        camera.pupil = 3_mm;
        camera.focus_depth = ball.z;
        camera.picture = {48, 36, 12_um, 12_um, 0, 0};
        const Spot waves = spot_of(photograph(*hologram, std::span(&camera, 1))[0], camera.picture);
        const Spot rays = spot_of(photograph(borrow(light.sources), std::span(&camera, 1))[0], camera.picture);
        EXPECT_NEAR(waves.x, rays.x, 15_um);
        EXPECT_NEAR(waves.y, rays.y, 15_um);
        // Wider by what a hogel diffracts, λζ/d, seen from the side.
        EXPECT_LT(waves.wide, 1.5 * rays.wide);
        // Where the line from the eye to the ball crosses the hologram.
        const double way = camera.eye.z / (camera.eye.z + ball.z);
        EXPECT_NEAR(waves.x, camera.eye.x + way * (ball.x - camera.eye.x), 20_um);
        EXPECT_NEAR(waves.y, camera.eye.y + way * (ball.y - camera.eye.y), 20_um);
    }
}

TEST(HemicubeStereogram, of_uniform_light_is_as_bright_from_all_sides_and_where_faces_meet) {
    const LightFieldGrid grid{14, 14, 36_um, 32, 32, Perspective{1, 1}, 1};
    const Hemicube light(grid, [](Vec3, Vec3) { return 0.5; });
    HologramOptions options;
    options.pitch = 0.36_um;
    options.looks = 6;
    const auto hologram = make_hologram(light.sources, options);
    for (const Vec3 towards : {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{-0.3, 1, 1}, Vec3{0, -1.3, 1}}) {
        Camera camera;
        camera.eye = 100_mm * normalize(towards);
        camera.pupil = 5_mm;
        camera.picture = {12, 12, 36_um, 36_um, 0, 0};
        EXPECT_NEAR(mean_of(photograph(*hologram, std::span(&camera, 1))[0]), 0.5, 0.025) << towards.x << towards.y;
    }
}

TEST(HemicubeStereogram, of_the_front_alone_is_that_of_its_front_face) {
    const LightFieldGrid grid{1, 1, 36_um, 48, 48, Perspective{1, 1}, 1};
    const std::vector<LightFieldGrid> faces = hemicube(grid);
    const FrequencyGrid front(faces.front(), 64, 633_nm), all(faces, 64, 633_nm);
    std::vector<float> radiance(all.rays()), a(std::size_t{64} * 64), b(a.size());
    for (std::size_t l = 0; l < 48; ++l)
        for (std::size_t k = 0; k < 48; ++k)
            radiance[l * 48 + k] = float(2 + std::sin(2 * grid.u(double(k))) * grid.v(double(l)));
    front.amplitudes(std::span(radiance).first(std::size_t{48} * 48), a);
    all.amplitudes(radiance, b);
    // Well within the front; its plain version takes a lobe for a rectangle in U and V.
    for (int j = -20; j <= 20; ++j)
        for (int i = -20; i <= 20; ++i) {
            const std::size_t at = std::size_t((64 - j) % 64) * 64 + std::size_t((64 + i) % 64);
            EXPECT_NEAR(b[at] / a[at], 1, 2e-3) << i << " " << j;
        }
}

// A field of the directions of a hogel's own transform, and one in perspective, of the same smooth light.
TEST(FrequencyGridLightField, is_taken_as_it_is_and_agrees_with_one_in_perspective) {
    const double wavelength = 532_nm, pitch = 64_um, step = wavelength / pitch;
    LightFieldGrid sines{2, 2, pitch, 31, 27, Perspective{15.5 * step, 13.5 * step}, 1};
    sines.view = Frequencies{sines.range()};
    ASSERT_TRUE(is_frequency_grid(sines, wavelength));
    EXPECT_FALSE(is_frequency_grid(sines, 633_nm));
    const auto light = [](Vec3 hogel, Vec3 way) {
        return 1 + 0.3 * std::sin(9 * way.x / way.z) * std::cos(7 * way.y / way.z) + 2000 * hogel.x;
    };
    const LightFieldBuffer exact = light_field_of(sines, light);
    const FrequencyGrid frequencies(sines, 64, wavelength);
    std::vector<float> moduli(std::size_t{64} * 64);
    frequencies.amplitudes({&exact.radiance(0, 1, 1, 0, 0), sines.directions()}, moduli);
    const LightFieldGrid tangents{2, 2, pitch, 301, 301, Perspective{0.15, 0.15}, 1};
    const LightFieldBuffer seen = light_field_of(tangents, light);
    std::vector<float> interpolated(std::size_t{64} * 64);
    FrequencyGrid(tangents, 64, wavelength)
        .amplitudes({&seen.radiance(0, 1, 1, 0, 0), tangents.directions()}, interpolated);
    for (int j = -13; j <= 13; ++j)
        for (int i = -15; i <= 15; ++i) {
            const std::size_t at = std::size_t((64 - j) % 64) * 64 + std::size_t((64 + i) % 64);
            const double cosine = std::sqrt(1 - (i * i + j * j) * step * step);
            // The ray of frequency (i, j)/d looks the other way: column 15 − i, and rows run down.
            const int l = 13 + j, k = 15 - i;
            const double L = exact.radiance(0, 1, 1, std::size_t(l), std::size_t(k));
            EXPECT_NEAR(moduli[at], step * std::sqrt(L / cosine), 1e-6 * step) << i << " " << j;
            EXPECT_NEAR(interpolated[at] / moduli[at], 1, 1e-3) << i << " " << j;
        }
}

TEST(FrequencyGridLightField, is_photographed_as_what_it_is) {
    const double wavelength = 633_nm, pitch = 50_um, step = wavelength / pitch;
    LightFieldGrid sines{24, 24, pitch, 17, 17, Perspective{8.5 * step, 8.5 * step}, 1};
    sines.view = Frequencies{sines.range()};
    const LightFieldBuffer light = light_field_of(sines, [](Vec3 hogel, Vec3 way) {
        return hogel.x + 2_mm * way.x / way.z > 0.1_mm ? 1.0 : 0.2;  // an edge behind the hologram
    });
    HologramOptions options;
    options.pitch = 2_um;
    options.looks = 4;
    const auto hologram = make_hologram(light, options);
    Camera camera;
    camera.eye = {3_mm, 0, 80_mm};
    camera.pupil = 3_mm;
    camera.focus_depth = 2_mm;
    camera.picture = {8, 1, 120_um, 900_um, 0, 0};
    const Image waves = photograph(*hologram, std::span(&camera, 1))[0];
    const Image rays = photograph(borrow(light), std::span(&camera, 1))[0];
    for (std::size_t x = 0; x < 8; ++x) EXPECT_NEAR(waves.pixels.data()[x], rays.pixels.data()[x], 0.1) << x;
}

// A small square behind the hologram, in lines that know nothing of each other: seen from the side it lies where
// geometry says, from above still at its own height, and where its x is in focus y is not: that lies on the hologram.
TEST(HorizontalParallax, focuses_across_at_the_depth_of_things_and_up_and_down_on_the_hologram) {
    const double depth = 8_mm, half = 64_um;
    const LightFieldGrid grid{24, 24, 64_um, 64, 1, Perspective{0.15, 0.01}, 1};
    const LightFieldBuffer light = light_field_of(grid, [&](Vec3 hogel, Vec3 way) {
        const double x = hogel.x + depth * way.x / way.z;
        return std::abs(x) < half && std::abs(hogel.y) < half ? 1.0 : 0.0;
    });
    HologramOptions options;
    options.pitch = 2_um;
    options.line_pitch = 4_um;
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
    // A disc A wide is A/4 in standard deviation, at the depth ζ in units of the hologram's plane A ζ/(R + ζ).
    const double blurred = std::hypot(sharp, 6_mm / 4 * depth / (100_mm + depth));
    const Spot far = seen(0, 0, depth), near = seen(0, 0, 0);
    EXPECT_NEAR(far.high, blurred, 0.15 * blurred);
    EXPECT_NEAR(near.wide, blurred, 0.15 * blurred);
    EXPECT_NEAR(near.high, sharp, 0.3 * sharp);
    // Across, a hogel is a slit, which makes it λζ/d wide.
    EXPECT_LT(far.wide, 0.7 * blurred);
    // From the side and from above.
    const double aside = 2_mm, above = 1_mm;
    EXPECT_NEAR(seen(aside, 0, depth).x, aside * depth / (100_mm + depth), 15_um);
    EXPECT_NEAR(seen(0, above, 0).y, 0, 6_um);
}

// A ball beyond the front's edge, on a side of a hemisquare: where geometry says across, at its own height up and down,
// and as wide as what a hogel diffracts.
TEST(HorizontalParallax, shows_a_ball_at_50_degrees_from_a_hemisquares_side) {
    const LightFieldGrid grid{16, 12, 36_um, 64, 1, Perspective{1, 0.1}, 1};
    for (const double side : {1.0, -1.0}) {
        const double angle = side * 50_deg;
        const Vec3 ball{2_mm * std::sin(angle), 72_um, 2_mm * std::cos(angle)};
        const Hemicube light(grid, [&](Vec3 hogel, Vec3 way) {
            const Vec3 to = ball - hogel, flat{to.x, 0, to.z};
            const double along = dot(flat, way) / dot(way, way);
            return along > 0 && length(flat - along * way) < 90_um && std::abs(to.y) < 90_um ? 1.0 : 0.0;
        });
        ASSERT_EQ(light.faces.size(), 3u);
        HologramOptions options;
        options.pitch = 0.36_um;
        options.line_pitch = 4_um;
        options.looks = 4;
        const auto hologram = make_hologram(light.sources, options);
        Camera camera;
        camera.eye = {-100_mm * std::sin(angle), 0, 100_mm * std::cos(angle)};
        camera.pupil = 3_mm;
        camera.focus_depth = ball.z;
        camera.picture = {48, 36, 12_um, 12_um, 0, 0};
        const Spot seen = spot_of(photograph(*hologram, std::span(&camera, 1))[0], camera.picture);
        const double way = camera.eye.z / (camera.eye.z + ball.z);
        EXPECT_NEAR(seen.x, camera.eye.x + way * (ball.x - camera.eye.x), 20_um);
        EXPECT_NEAR(seen.y, ball.y, 12_um);
        const double wide = 2 * 90_um / std::cos(angle) / std::sqrt(12.0);
        EXPECT_NEAR(seen.wide, wide, 0.35 * wide);
    }
    const Hemicube even(grid, [](Vec3, Vec3) { return 0.5; });
    HologramOptions options;
    options.pitch = 0.36_um;
    options.line_pitch = 4_um;
    options.looks = 6;
    const auto hologram = make_hologram(even.sources, options);
    for (const double angle : {0_deg, 45_deg, -55_deg}) {
        Camera camera;
        camera.eye = {100_mm * std::sin(angle), 0, 100_mm * std::cos(angle)};
        camera.pupil = 3_mm;
        camera.picture = {10, 10, 36_um, 36_um, 0, 0};
        EXPECT_NEAR(mean_of(photograph(*hologram, std::span(&camera, 1))[0]), 0.5, 0.04) << angle;
    }
}

TEST(HorizontalParallax, is_as_bright_as_the_light_field_says_whatever_the_distance_of_lines) {
    const LightFieldGrid grid{8, 8, 160_um, 30, 1, Perspective{0.12, 0.01}, 1};
    const LightFieldBuffer light = light_field_of(grid, [](Vec3, Vec3) { return 0.7; });
    for (const auto& [lines, phases] : {std::pair{4_um, Phases::random},
                                        {10_um, Phases::random},
                                        {10_um, Phases::fixed},
                                        {10_um, Phases::designed}}) {
        HologramOptions options;
        options.pitch = 2_um;
        options.line_pitch = lines;
        options.phases = phases;
        options.looks = 6;
        Camera camera;
        camera.eye = {5_mm, 0, 100_mm};
        camera.pupil = 2.5_mm;  // hogels that are alike send light in directions λ/d apart, 0.4 mm there
        camera.picture = {8, 8, 100_um, 100_um, 0, 0};
        const auto hologram = make_hologram(light, options);
        EXPECT_NEAR(mean_of(photograph(*hologram, std::span(&camera, 1))[0]), 0.7, 0.04) << lines;
    }
}

// What lines share makes their fringe flat; what is their own, a phase, sends light up and down alike.
TEST(HorizontalParallax, designed_phases_flatten_the_fringe_of_every_line) {
    const LightFieldGrid grid{8, 8, 160_um, 30, 1, Perspective{0.12, 0.01}, 1};
    const LightFieldBuffer light = light_field_of(grid, [](Vec3, Vec3) { return 0.7; });
    HologramOptions options;
    options.pitch = 2_um;
    options.line_pitch = 10_um;
    const auto peak = [&](Phases phases) {
        options.phases = phases;
        const auto hologram = make_hologram(light, options);
        Field field(hologram->grid());
        copy(*hologram, field);
        double largest = 0, sum = 0;
        for (const Complex value : field.samples.elements()) {
            largest = std::max<double>(largest, std::norm(value));
            sum += std::norm(value);
        }
        return largest * static_cast<double>(field.samples.size()) / sum;
    };
    EXPECT_GT(peak(Phases::random), 6);
    EXPECT_LT(peak(Phases::designed), 2.5);
    options.phases = Phases::designed;
    Camera above;
    above.eye = {0, 1.5_mm, 100_mm};
    above.pupil = 2.5_mm;
    above.picture = {8, 8, 100_um, 100_um, 0, 0};
    options.looks = 6;
    EXPECT_NEAR(mean_of(photograph(*make_hologram(light, options), std::span(&above, 1))[0]), 0.7, 0.05);
}

// Of every kind the same bytes in any tiling: hogels are keyed by their place, lines by their number.
TEST(StereogramOfAnyKind, gives_the_same_bytes_in_any_tiling) {
    const auto light = [](Vec3 hogel, Vec3 way) { return 1 + 3000 * hogel.x + way.x / length(way); };
    const LightFieldGrid grid{6, 5, 36_um, 16, 16, Perspective{1, 1}, 1};
    const Hemicube cube(grid, light);
    const LightFieldBuffer row = light_field_of({6, 5, 36_um, 16, 1, Perspective{0.1, 0.1}, 1}, light);
    HologramOptions fine, lines;
    fine.pitch = 0.36_um;
    lines.pitch = 3_um;
    lines.line_pitch = 9_um;
    for (const auto& source : {make_hologram(cube.sources, fine), make_hologram(row, lines)}) {
        const Grid& plane = source->grid().plane;
        Array<Complex, 2> whole({plane.height, plane.width});
        source->read({0, 0, plane.width, plane.height}, 0, whole);
        EXPECT_NE(whole(0, 0), whole(1, 0));
        for (const Region& region : {Region{7, 3, 50, 11}, Region{plane.width - 1, plane.height - 1, 1, 1}}) {
            Array<Complex, 2> part({region.height, region.width});
            source->read(region, 0, part);
            for (std::size_t y = 0; y < region.height; ++y)
                for (std::size_t x = 0; x < region.width; ++x)
                    ASSERT_EQ(part(y, x), whole(region.y0 + y, region.x0 + x)) << x << " " << y;
        }
    }
}

void expect_usage(std::span<const LightFieldSource* const> faces, const HologramOptions& options,
                  const std::string& part) {
    try {
        make_hologram(faces, options);
        ADD_FAILURE() << "expected: " << part;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(StereogramOfAnyKind, refuses_what_cannot_be_with_what_would_do) {
    const auto light = [](Vec3, Vec3) { return 1.0; };
    const Hemicube cube({2, 2, 36_um, 8, 8, Perspective{1, 1}, 1}, light);
    HologramOptions options;
    options.pitch = 0.36_um;
    options.method = Method::basis;
    options.phases = Phases::fixed;
    expect_usage(cube.sources, options, "only the method fourier");
    const LightFieldSource* const left[] = {cube.sources[1]};
    expect_usage(left, {}, "begins with the front face");
    const LightFieldBuffer other = light_field_of({3, 2, 36_um, 8, 8, Perspective{1, 1}, 1}, light);
    const LightFieldSource* const mixed[] = {&other, cube.sources[1]};
    expect_usage(mixed, {}, "other hogels");

    const LightFieldBuffer full = light_field_of({2, 2, 36_um, 8, 6, Perspective{0.1, 0.1}, 1}, light);
    const LightFieldSource* const only[] = {&full};
    options = {};
    options.pitch = 3_um;
    options.line_pitch = 9_um;
    expect_usage(only, options, "8x1 directions would do");
    const Hemicube whole({2, 2, 36_um, 8, 8, Perspective{1, 1}, 1}, light);
    expect_usage(whole.sources, options, "8x1 directions would do");
    options.phases = Phases::phase_added;
    expect_usage(only, options, "random, fixed or designed phases");

    LightFieldGrid sines{2, 2, 36_um, 31, 31, Perspective{15.5 * 633e-9 / 36e-6, 15.5 * 633e-9 / 36e-6}, 1};
    sines.view = Frequencies{sines.range()};
    const LightFieldBuffer exact(sines, true);
    const LightFieldSource* const grid[] = {&exact};
    options = {};
    options.pitch = 1.8_um;  // 20 samples a hogel, of frequencies up to 10
    expect_usage(grid, options, "a pitch of 1.2 um or less would do");
    options.pitch = 1.2_um;
    EXPECT_NO_THROW(make_hologram(grid, options));
    options.phases = Phases::phase_added;
    expect_usage(grid, options, "uniform in sines");
}

}  // namespace
}  // namespace hogel::hologram
