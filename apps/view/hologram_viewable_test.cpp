// SPDX-License-Identifier: Apache-2.0
#include "view/hologram_viewable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "hogel/error.h"

namespace hogel::view {
namespace {

constexpr double wavelength = 633e-9, pitch = 4e-6;
constexpr std::size_t side = 256;
using std::numbers::pi;

// Points a depth behind the hologram, and a plane wave of a known frequency where there are none.
Fields points(double depth) {
    auto field = std::make_shared<Field>(FieldGrid{{side, side, pitch, pitch}, wavelength});
    const Grid& plane = field->grid().plane;
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x)
            for (const auto& [px, py] : {std::pair{0.0, 0.0}, {2e-4, 1e-4}, {-3e-4, -2e-4}}) {
                const double dx = plane.x(static_cast<double>(x)) - px, dy = plane.y(static_cast<double>(y)) - py;
                const double r = std::sqrt(dx * dx + dy * dy + depth * depth);
                field->samples(y, x) +=
                    std::polar(1.0f, static_cast<float>(std::remainder(2 * pi * r / wavelength, 2 * pi)));
            }
    return {field};
}

// F = e^{2πi (x/8 + y/16)}, in samples, y upwards.
Fields tilted() {
    auto field = std::make_shared<Field>(FieldGrid{{side, side, pitch, pitch}, wavelength});
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            const double cycles = static_cast<double>(x) / 8 - static_cast<double>(y) / 16;
            field->samples(y, x) = std::polar(2.0f, static_cast<float>(2 * pi * (cycles - std::floor(cycles))));
        }
    return {field};
}

PictureQuery query() {
    PictureQuery query;
    query.camera.eye = {0, 0, 0.1};
    query.camera.pupil = 3e-3;
    query.camera.resolution = {64, 64};
    query.by = PictureMethod::waves;
    return query;
}

TEST(HologramViewable, pictures_equal_those_of_photograph) {
    const Fields fields = points(3e-3);
    HologramViewable one(fields, std::size_t{1} << 30, {});
    const Camera camera = one.camera(query());
    const Image expected = photograph_colours(fields, {&camera, 1}).front();
    EXPECT_TRUE(std::ranges::equal(one.photograph(query(), {}).picture.pixels.elements(), expected.pixels.elements()));
    EXPECT_EQ(one.looks(), 1u);
}

TEST(HologramViewable, finds_the_planes_in_focus) {
    const double depth = 4e-3;
    HologramViewable one(points(depth), std::size_t{1} << 30, {});
    const FocusSearch search = one.find_focus({});
    ASSERT_FALSE(search.planes.empty());
    EXPECT_NEAR(search.planes.front().depth, depth, 0.3e-3);
    EXPECT_NEAR(one.focus(query(), {0.5, 0.5}, {}), depth, 0.5e-3);
}

TEST(HologramViewable, shows_fringes_to_the_sample) {
    const Fields fields = tilted();
    HologramViewable one(fields, std::size_t{1} << 30, {});
    const Photograph phase = one.inside(query(), {0.5, 0.5}, {"phase", 0, 32}, {});
    ASSERT_EQ(phase.picture.width(), 32u);
    const auto& samples = dynamic_cast<const Field&>(*fields.front()).samples;
    for (std::size_t y = 0; y < 32; ++y)
        for (std::size_t x = 0; x < 32; ++x) {
            const double cycles = std::arg(samples(side / 2 - 16 + y, side / 2 - 16 + x)) / (2 * pi);
            EXPECT_NEAR(srgb_encode(phase.picture.pixels(y, x, 0)), 0.5 + cycles, 1e-3);
        }
    EXPECT_THROW(one.inside(query(), {0.5, 0.5}, {"hogel", 0, 32}, {}), Error);
    // At the edge it stays on the hologram.
    EXPECT_EQ(one.inside(query(), {1, 1}, {"real", 0, 32}, {}).picture.height(), 32u);
}

// The brightest frequency is that of the wave: x to the right, y upwards.
TEST(HologramViewable, shows_the_local_spectrum) {
    HologramViewable one(tilted(), std::size_t{1} << 30, {});
    const Image spectrum = one.inside(query(), {0.5, 0.5}, {"spectrum", 0, 128}, {}).picture;
    ASSERT_EQ(spectrum.width(), 128u);
    const auto all = spectrum.pixels.elements();
    const auto brightest = static_cast<std::size_t>(std::ranges::max_element(all) - all.begin());
    const std::size_t column = brightest % 128, row = brightest / 128;
    const double x = static_cast<double>(column) - 64, y = 64 - static_cast<double>(row);
    EXPECT_NEAR(x, 128.0 / 8, 1);
    EXPECT_NEAR(y, 128.0 / 16, 1);
}

TEST(HologramViewable, reads_the_sample_under_the_pointer) {
    HologramViewable one(tilted(), std::size_t{1} << 30, {});
    const Reading reading = one.read(query(), {0.5, 0.5});
    ASSERT_TRUE(reading.inside);
    EXPECT_NEAR(reading.radiance[0], 4, 1e-4);
    EXPECT_TRUE(reading.phase);
    EXPECT_NEAR(one.facts()["efficiency"].get<double>(), 1, 1e-5);
}

TEST(HologramViewable, takes_one_or_three_wavelengths) {
    Fields two = tilted();
    two.push_back(two.front());
    EXPECT_THROW(HologramViewable(two, std::size_t{1} << 30, {}), Error);
}

}  // namespace
}  // namespace hogel::view
