// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/rays/exposure.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "hogel/camera/rays/ray_kernels.h"
#include "hogel/core/half.h"
#include "hogel/core/test_targets.h"
#include "hogel/image/film.h"
#include "hogel/photograph.h"
#include "hogel/units.h"

namespace hogel::camera::rays {
namespace {

using namespace literals;

HOGEL_TEST_ON_EVERY_TARGET(RayKernels);
HOGEL_TEST_ON_EVERY_TARGET(Exposures);

std::vector<float> noise(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<float> values(count);
    for (float& value : values) value = uniform(random);
    return values;
}

// Positions on a line that neighbours often share, with occasional jumps.
std::vector<std::int32_t> places(std::size_t count, std::size_t below) {
    std::vector<std::int32_t> low(count);
    for (std::size_t i = 0; i < count; ++i) low[i] = static_cast<std::int32_t>((i % 7 == 0 ? 5 * i : i / 2) % below);
    return low;
}

TEST_P(RayKernels, look_between_directions_as_the_plain_twin_does) {
    const std::size_t directions = 9, rows = 5, hogel = directions * rows;
    for (std::size_t width = 0; width <= 70; ++width)
        for (const std::size_t next : {0u, 1u}) {
            const std::vector<float> radiance = noise(hogel * width + hogel), weights = noise(width);
            const std::vector<std::int32_t> low = places(width, directions - 1);
            const HogelRows hogels{radiance.data() + directions, radiance.data() + 3 * directions, hogel, next, 0.3f};
            std::vector<float> fast(width, 7), plain(width, 7);
            sample_between(hogels, {low, weights}, fast);
            sample_between_plain(hogels, {low, weights}, plain);
            ASSERT_EQ(fast, plain) << width;
        }
}

TEST_P(RayKernels, look_along_hogels_as_the_plain_twin_does) {
    const std::vector<float> samples = noise(400);
    std::vector<std::uint16_t> halves(samples.size());
    core::to_half(samples.data(), halves.data(), samples.size());
    for (std::size_t width = 0; width <= 70; ++width) {
        const std::vector<float> weights = noise(width);
        const auto four = [](const auto* at) { return FourDirections{at, at + 100, at + 200, at + 300}; };
        std::vector<float> fast(width, 7), plain(width, 7);
        sample_along(four(samples.data()), weights, 0.3f, fast);
        sample_along_plain(four(samples.data()), weights, 0.3f, plain);
        ASSERT_EQ(fast, plain) << width;
        sample_along(four(halves.data()), weights, 0.3f, fast);
        sample_along_plain(four(halves.data()), weights, 0.3f, plain);
        ASSERT_EQ(fast, plain) << width;
    }
}

TEST_P(RayKernels, add_and_mix_as_the_plain_twins_do) {
    for (std::size_t width = 0; width <= 70; ++width) {
        const std::vector<float> line = noise(40), weights = noise(width), a = noise(2 * width);
        const std::vector<std::int32_t> low = places(width, 39);
        std::vector<float> fast(width, 7), plain(width, 7);
        add_between(line, 1, {low, weights}, fast);
        add_between_plain(line, 1, {low, weights}, plain);
        ASSERT_EQ(fast, plain) << width;
        mix_lines(std::span(a).first(width), std::span(a).last(width), 0.7f, fast);
        mix_lines_plain(std::span(a).first(width), std::span(a).last(width), 0.7f, plain);
        ASSERT_EQ(fast, plain) << width;
    }
}

LightFieldBuffer noise_on(const LightFieldGrid& grid) {
    LightFieldBuffer light_field(grid);
    std::ranges::copy(noise(light_field.radiance.size()), light_field.radiance.data());
    return light_field;
}

Image picture_of(const LightFieldBuffer& light_field, const Camera& camera, Implementation implementation,
                 std::size_t hogels_across) {
    const LightFieldGrid& grid = light_field.grid();
    Exposure exposure({grid}, camera, 9, implementation);
    const std::size_t cells_s = std::max<std::size_t>(grid.hogels_s - 1, 1),
                      cells_t = std::max<std::size_t>(grid.hogels_t - 1, 1);
    for (std::size_t s = 0; s < cells_s; s += hogels_across) {
        const HogelRange cells{s, 0, std::min(hogels_across, cells_s - s), cells_t};
        const HogelRange hogels{s, 0, std::min(cells.ns + 1, grid.hogels_s - s), grid.hogels_t};
        exposure.add(0, block_of(light_field.radiance, 0, 0, hogels), cells);
    }
    Image image;
    image::load_film(std::span(&camera, 1), grid.channels, {}, std::span(&image, 1));
    exposure.develop(image);
    return image;
}

// Few directions, one direction, and one hogel; viewpoints in front of the middle and so far aside that a part of the
// hologram is black.
const std::vector<LightFieldGrid> grids{
    {50, 9, 100_um, 12, 10, Perspective{0.05, 0.02}, 3},
    {50, 9, 100_um, 12, 60, Perspective{0.05, 0.02}, 1},
    {50, 9, 100_um, 12, 10, FocalPlane{{0.05, 0.02}, -60_mm}, 3},
    {50, 9, 100_um, 100, 10, Perspective{0.05, 0.02}, 1},
    {50, 9, 100_um, 1, 10, Perspective{0.05, 0.02}, 1},
    {50, 9, 100_um, 12, 1, Perspective{{0.05, 0.02, 0.01, 0.01}}, 1},
    {1, 9, 1_mm, 12, 10, Perspective{0.07, 0.02}, 1},
};

Camera camera_at(double eye) {
    Camera camera;
    camera.eye = {eye, -1e-3, 0.1};
    camera.focus_depth = 3_mm;
    camera.pupil = 2_mm;
    camera.picture = {71, 20, 80_um, 60_um, 0.2_mm, 0};
    return camera;
}

void expect_same(const Image& a, const Image& b, const std::string& what) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        ASSERT_EQ(a.pixels.data()[i], b.pixels.data()[i]) << what << " " << i;
        sum += std::abs(b.pixels.data()[i]);
    }
    EXPECT_GT(sum, 0) << what;
}

TEST_P(Exposures, are_the_same_ray_by_ray_and_by_vectors) {
    for (std::size_t i = 0; i < grids.size(); ++i) {
        const LightFieldBuffer light_field = noise_on(grids[i]);
        for (const double eye : {0.0, 4e-3, 6e-3})
            for (const std::size_t across : {60u, 17u}) {
                const Camera camera = camera_at(eye);
                expect_same(picture_of(light_field, camera, Implementation::fast, across),
                            picture_of(light_field, camera, Implementation::plain, across),
                            fmt::format("{} {}", i, eye));
            }
    }
}

// Halves hold numbers of eleven bits, so the noise is rounded to halves first.
TEST_P(Exposures, of_a_photographer_are_those_of_a_light_field) {
    for (std::size_t i = 0; i < grids.size(); ++i) {
        LightFieldBuffer light_field = noise_on(grids[i]);
        for (float& value : light_field.radiance.elements()) value = core::float_of(core::half_of(value));
        const std::size_t bytes = light_field.radiance.size() * sizeof(float);
        RayPhotographer floats(borrow(light_field), {.memory = bytes}),
            halves(borrow(light_field), {.memory = bytes / 2});
        EXPECT_THROW(RayPhotographer(borrow(light_field), {.memory = bytes / 2 - 1}), Error);
        for (const double eye : {0.0, 4e-3, 6e-3}) {
            const Camera camera = camera_at(eye);
            const Image expected = photograph(borrow(light_field), std::span(&camera, 1), {9})[0];
            expect_same(floats.photograph(camera, {9}), expected, fmt::format("{} {}", i, eye));
            expect_same(halves.photograph(camera, {9}), expected, fmt::format("{} {}", i, eye));
        }
    }
}

// Light fields without separable directions are read by each photograph.
TEST(RayPhotographer, shows_directions_in_sines_and_hemicubes_too) {
    const LightFieldBuffer sines = noise_on({20, 9, 100_um, 12, 10, Frequencies{{0.05, 0.02}}, 1});
    std::vector<LightFieldBuffer> faces;
    for (const LightFieldGrid& face : hemicube({20, 9, 100_um, 12, 10, {}, 1})) faces.push_back(noise_on(face));
    std::vector<const LightFieldSource*> sources;
    for (const LightFieldBuffer& face : faces) sources.push_back(&face);
    const Camera camera = camera_at(1e-3);
    for (const LightField& light_field : {borrow(sines), borrow(sources)})
        expect_same(RayPhotographer(light_field).photograph(camera, {9}),
                    photograph(light_field, std::span(&camera, 1), {9})[0], "");
}

TEST(RayPhotographer, stops_in_the_middle) {
    const LightFieldBuffer light_field = noise_on(grids[0]);
    std::stop_source stop;
    RayPhotographer photographer(borrow(light_field));
    const Progress progress(stop.get_token());
    stop.request_stop();
    try {
        photographer.photograph(camera_at(0), {}, progress);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
    expect_same(photographer.photograph(camera_at(0)), photograph(borrow(light_field), std::array{camera_at(0)})[0],
                "");
}

}  // namespace
}  // namespace hogel::camera::rays
