// SPDX-License-Identifier: Apache-2.0
#include "hogel/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel {
namespace {

// One value per pixel, [y][x], e.g. the luma of display values (Rec. 709 weights, as for the sRGB primaries).
using Plane = Array<double, 2>;

constexpr std::size_t values_between_checks = 1 << 18;  // loops on one thread check for a stop request at this interval

float display(float linear, double exposure) { return srgb_encode(static_cast<float>(linear * exposure)); }

Plane display_luma(const Image& image, double exposure) {
    Plane luma({image.height(), image.width()});
    work::parallel_for(image.height(), [&](std::size_t y) {
        for (std::size_t x = 0; x < image.width(); ++x) {
            const auto value = [&](std::size_t c) { return display(image.pixels(y, x, c), exposure); };
            luma(y, x) = image.channels() == 3 ? 0.2126 * value(0) + 0.7152 * value(1) + 0.0722 * value(2) : value(0);
        }
    });
    return luma;
}

// Returns the window of Wang et al., with 11 taps, or the largest odd number of taps that fits into the picture.
std::vector<double> gaussian_window(std::size_t extent) {
    const std::size_t taps = std::min<std::size_t>(11, extent % 2 == 1 ? extent : extent - 1);
    std::vector<double> window(taps);
    double sum = 0;
    for (std::size_t i = 0; i < taps; ++i) {
        const double x = static_cast<double>(i) - 0.5 * static_cast<double>(taps - 1);
        sum += window[i] = std::exp(-x * x / (2 * 1.5 * 1.5));
    }
    for (double& tap : window) tap /= sum;
    return window;
}

// Returns weighted means of f(y, x) over all windows that are completely inside the picture.
template <class F>
Plane local_mean(std::size_t height, std::size_t width, const F& f) {
    const std::vector<double> across = gaussian_window(width), down = gaussian_window(height);
    const std::size_t valid_width = width - across.size() + 1, valid_height = height - down.size() + 1;
    Plane rows({height, valid_width}), means({valid_height, valid_width});
    work::parallel_for(height, [&](std::size_t y) {
        for (std::size_t x = 0; x < valid_width; ++x)
            for (std::size_t i = 0; i < across.size(); ++i) rows(y, x) += across[i] * f(y, x + i);
    });
    work::parallel_for(valid_height, [&](std::size_t y) {
        for (std::size_t i = 0; i < down.size(); ++i)
            for (std::size_t x = 0; x < valid_width; ++x) means(y, x) += down[i] * rows(y + i, x);
    });
    return means;
}

double structural_similarity(const Plane& a, const Plane& b) {
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    const std::size_t height = a.extent(0), width = a.extent(1);
    const auto mean_of = [&](const auto& f) { return local_mean(height, width, f); };
    const Plane mean_a = mean_of([&](std::size_t y, std::size_t x) { return a(y, x); });
    const Plane mean_b = mean_of([&](std::size_t y, std::size_t x) { return b(y, x); });
    const Plane mean_aa = mean_of([&](std::size_t y, std::size_t x) { return a(y, x) * a(y, x); });
    const Plane mean_bb = mean_of([&](std::size_t y, std::size_t x) { return b(y, x) * b(y, x); });
    const Plane mean_ab = mean_of([&](std::size_t y, std::size_t x) { return a(y, x) * b(y, x); });
    double sum = 0;
    for (std::size_t i = 0; i < mean_a.size(); ++i) {
        if (i % values_between_checks == 0) core::throw_if_stopped();
        const double ma = mean_a.elements()[i], mb = mean_b.elements()[i];
        const double var_a = mean_aa.elements()[i] - ma * ma, var_b = mean_bb.elements()[i] - mb * mb;
        const double covariance = mean_ab.elements()[i] - ma * mb;
        sum += (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (var_a + var_b + c2));
    }
    return sum / static_cast<double>(mean_a.size());
}

double decibels(double peak, double squares, std::size_t samples) {
    if (squares == 0) return std::numeric_limits<double>::infinity();
    return 10 * std::log10(peak * peak * static_cast<double>(samples) / squares);
}

}  // namespace

ImageComparison compare(const Image& a, const Image& b, double exposure) {
    if (a.pixels.shape() != b.pixels.shape() || a.pixels.size() == 0)
        throw Error(ErrorCode::bad_input,
                    fmt::format("pictures of {}x{} pixels in {} channels and of {}x{} in {} cannot be compared",
                                a.width(), a.height(), a.channels(), b.width(), b.height(), b.channels()));
    if (!(std::isfinite(exposure) && exposure > 0))
        throw Error(ErrorCode::usage, "exposure",
                    fmt::format("the exposure is {}, but must be positive and finite", exposure));
    const auto has_nan = [](const Image& image) {
        return std::ranges::any_of(image.pixels.elements(), [](float value) { return std::isnan(value); });
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (has_nan(a) || has_nan(b)) return {nan, nan, nan, nan};
    ImageComparison result;
    double display_squares = 0, linear_squares = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        if (i % values_between_checks == 0) core::throw_if_stopped();
        const float va = a.pixels.elements()[i], vb = b.pixels.elements()[i];
        const double error = static_cast<double>(display(va, exposure)) - display(vb, exposure);
        display_squares += error * error;
        result.max_error = std::max(result.max_error, std::abs(error));
        if (va != vb) linear_squares += (static_cast<double>(va) - vb) * (static_cast<double>(va) - vb);
    }
    result.psnr = decibels(1, display_squares, a.pixels.size());
    result.linear_psnr = decibels(1 / exposure, linear_squares, a.pixels.size());
    result.ssim = structural_similarity(display_luma(a, exposure), display_luma(b, exposure));
    return result;
}

}  // namespace hogel
