// SPDX-License-Identifier: Apache-2.0
#include "hogel/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hogel/core/stop_scope.h"
#include "hogel/work/parallel.h"

namespace hogel {

// IEC 61966-2-1, with its published constants.
float srgb_encode(float linear) {
    if (!(linear > 0)) return 0;  // NaN too
    if (linear >= 1) return 1;
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float srgb_decode(float display) {
    if (!(display > 0)) return 0;
    if (display >= 1) return 1;
    return display <= 0.04045f ? display / 12.92f : std::pow((display + 0.055f) / 1.055f, 2.4f);
}

namespace {

// Returns the median of the values above a limit; 0 if fewer than 1 % are above it.
double median_above(std::vector<float> values, float limit) {
    const std::size_t count = values.size();
    std::erase_if(values, [&](float value) { return !(value > limit); });
    if (values.size() < count / 100 + 1) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Returns whether a pixel shows the background, within the compression error. A black background does not count.
bool is_background(const Image& image, std::size_t x, std::size_t y, Rgb background) {
    const std::array<float, 3> expected{background.r, background.g, background.b};
    const float tolerance = 0.02f * std::max({background.r, background.g, background.b});
    if (!(tolerance > 0) || image.channels() != 3) return false;
    for (std::size_t c = 0; c < 3; ++c)
        if (!(std::abs(image.pixels(y, x, c) - expected[c]) <= tolerance)) return false;
    return true;
}

}  // namespace

double automatic_exposure(const Image& image) {
    const Rgb background = background_of(image.provenance);
    std::vector<float> largest(image.width() * image.height());
    work::parallel_for(image.height(), [&](std::size_t y) {
        for (std::size_t x = 0; x < image.width(); ++x) {
            float value = 0;
            for (std::size_t c = 0; c < image.channels(); ++c) {
                const float sample = image.pixels(y, x, c);
                if (std::isfinite(sample)) value = std::max(value, sample);
            }
            largest[y * image.width() + x] = is_background(image, x, y, background) ? 0 : value;
        }
    });
    if (largest.empty()) return 1;
    const auto rank = static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(largest.size() - 1));
    std::nth_element(largest.begin(), largest.begin() + rank, largest.end());
    core::throw_if_stopped();
    float white = largest[static_cast<std::size_t>(rank)];
    // Uses the maximum if fewer than 0.5 % of the pixels are not black.
    if (!(white > 0)) white = *std::max_element(largest.begin(), largest.end());
    if (!(white > 0)) return 1;
    constexpr double brightest_median = 0.55;
    const double median = median_above(std::move(largest), 1e-3f * white);
    const double brightest = 1 / static_cast<double>(white);
    return median > 0 ? std::min(brightest, brightest_median / median) : brightest;
}

}  // namespace hogel
