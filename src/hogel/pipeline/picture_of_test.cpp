// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/pipeline.h"

namespace hogel::pipeline {
namespace {

using Complex = std::complex<float>;

Field waves(std::size_t width, std::size_t height) {
    Field field({{width, height, 1e-6, 1e-6, 0, 0}, 532e-9});
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            field.samples(y, x) = std::polar(0.5f + 0.25f * static_cast<float>(x), static_cast<float>(y) - 1);
    field.set_provenance({{{"scene", "waves"}}, {}});
    return field;
}

float grey_of(const Image& picture, std::size_t y, std::size_t x) { return srgb_encode(picture.pixels(y, x, 0)); }

TEST(PictureOf, quantities_agree_with_each_other) {
    const Field field = waves(5, 3);
    const Image intensity = picture_of(field), amplitude = picture_of(field, FieldQuantity::amplitude),
                phase = picture_of(field, FieldQuantity::phase), real = picture_of(field, FieldQuantity::real);
    EXPECT_EQ(intensity.width(), 5u);
    EXPECT_EQ(intensity.height(), 3u);
    EXPECT_EQ(intensity.channels(), 1u);
    EXPECT_EQ(intensity.provenance, field.provenance());
    const float largest = 1.5f;
    for (std::size_t y = 0; y < 3; ++y)
        for (std::size_t x = 0; x < 5; ++x) {
            const Complex value = field.samples(y, x);
            EXPECT_NEAR(intensity.pixels(y, x, 0), (value * std::conj(value)).real(), 1e-6);
            EXPECT_NEAR(std::pow(amplitude.pixels(y, x, 0), 2), intensity.pixels(y, x, 0), 1e-6);
            const float angle = (2 * grey_of(phase, y, x) - 1) * static_cast<float>(std::numbers::pi);
            EXPECT_NEAR(std::abs(std::polar(amplitude.pixels(y, x, 0), angle) - value), 0, 1e-5);
            EXPECT_NEAR((2 * grey_of(real, y, x) - 1) * largest, value.real(), 1e-5);
        }
}

TEST(PictureOf, darkness_is_no_number_out_of_range) {
    const Field dark({{4, 2, 1e-6, 1e-6, 0, 0}, 532e-9});
    const auto all = [](const Image& picture, float expected) {
        return std::ranges::all_of(picture.pixels.elements(),
                                   [&](float value) { return std::abs(srgb_encode(value) - expected) < 1e-6f; });
    };
    EXPECT_TRUE(all(picture_of(dark), 0));
    EXPECT_TRUE(all(picture_of(dark, FieldQuantity::amplitude), 0));
    EXPECT_TRUE(all(picture_of(dark, FieldQuantity::phase), 0.5f));
    EXPECT_TRUE(all(picture_of(dark, FieldQuantity::real), 0.5f));
    EXPECT_TRUE(all(logarithmic(picture_of(dark)), 0));
}

TEST(Logarithmic, spreads_four_decades_over_the_greys) {
    Image intensities(6, 1, 1);
    for (std::size_t decade = 0; decade < 6; ++decade)
        intensities.pixels(0, decade, 0) = 300 * std::pow(10.0f, -static_cast<float>(decade));
    const Image greys = logarithmic(intensities);
    for (std::size_t decade = 0; decade < 6; ++decade)
        EXPECT_NEAR(grey_of(greys, 0, decade), std::max(0.0, 1 - 0.25 * static_cast<double>(decade)), 1e-5);
}

}  // namespace
}  // namespace hogel::pipeline
