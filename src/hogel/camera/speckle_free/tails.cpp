// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/speckle_free/tails.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "hogel/math/fft.h"

namespace hogel::camera::speckle_free {
namespace {

using Complex = std::complex<float>;

constexpr std::size_t max_side = 1024;

Array<float, 2> in_bins(View<const float, 2> light, std::size_t bin) {
    Array<float, 2> sums({(light.extent(0) + bin - 1) / bin, (light.extent(1) + bin - 1) / bin});
    for (std::size_t y = 0; y < light.extent(0); ++y)
        for (std::size_t x = 0; x < light.extent(1); ++x) sums(y / bin, x / bin) += light(y, x);
    return sums;
}

}  // namespace

Array<float, 2> spread_tails(View<const float, 2> light, std::size_t inner_radius, double outer_radius) {
    Array<float, 2> spread(light.shape());
    const std::size_t bin = (std::max(light.extent(0), light.extent(1)) + max_side - 1) / max_side;
    const Array<float, 2> sums = in_bins(light, bin);
    const auto inner_hogels = static_cast<double>(inner_radius), step = static_cast<double>(bin);
    const auto outer_bins = static_cast<std::ptrdiff_t>(std::floor(outer_radius / step));
    const auto weight = [&](std::ptrdiff_t y, std::ptrdiff_t x) {
        const double dy = step * static_cast<double>(y), dx = step * static_cast<double>(x), r = std::hypot(dx, dy);
        return std::max(std::abs(dx), std::abs(dy)) <= inner_hogels || r > outer_radius ? 0.0 : 1 / (r * r * r);
    };
    double total = 0;
    for (std::ptrdiff_t y = -outer_bins; y <= outer_bins; ++y)
        for (std::ptrdiff_t x = -outer_bins; x <= outer_bins; ++x) total += weight(y, x);
    if (total == 0) return spread;
    const auto rows = static_cast<std::ptrdiff_t>(sums.extent(0)),
               columns = static_cast<std::ptrdiff_t>(sums.extent(1));
    const std::ptrdiff_t down = std::min(outer_bins, rows - 1), across = std::min(outer_bins, columns - 1);
    const std::size_t height = math::good_fft_size(static_cast<std::size_t>(rows + down)),
                      width = math::good_fft_size(static_cast<std::size_t>(columns + across));
    Array<Complex, 2> kernel({height, width}), values({height, width});
    for (std::ptrdiff_t y = -down; y <= down; ++y)
        for (std::ptrdiff_t x = -across; x <= across; ++x)
            kernel((static_cast<std::size_t>(y) + height) % height, (static_cast<std::size_t>(x) + width) % width) =
                static_cast<float>(weight(y, x) / (total * step * step * static_cast<double>(height * width)));
    for (std::size_t y = 0; y < sums.extent(0); ++y)
        for (std::size_t x = 0; x < sums.extent(1); ++x) values(y, x) = sums(y, x);
    const math::Fft2 fft(height, width);
    fft.forward(kernel);
    fft.forward(values);
    for (std::size_t i = 0; i < values.size(); ++i) values.data()[i] *= kernel.data()[i];
    fft.backward(values);
    for (std::size_t y = 0; y < spread.extent(0); ++y)
        for (std::size_t x = 0; x < spread.extent(1); ++x) spread(y, x) = values(y / bin, x / bin).real();
    return spread;
}

float interpolate(View<const float, 2> values, double row, double column) {
    const auto clamped = [](double position, std::size_t count) {
        return std::clamp(position, 0.0, static_cast<double>(count - 1));
    };
    const double y = clamped(row, values.extent(0)), x = clamped(column, values.extent(1));
    const auto top = static_cast<std::size_t>(y), left = static_cast<std::size_t>(x);
    const std::size_t bottom = std::min(top + 1, values.extent(0) - 1),
                      right = std::min(left + 1, values.extent(1) - 1);
    const auto v = static_cast<float>(y - static_cast<double>(top)),
               u = static_cast<float>(x - static_cast<double>(left));
    return (1 - v) * ((1 - u) * values(top, left) + u * values(top, right)) +
           v * ((1 - u) * values(bottom, left) + u * values(bottom, right));
}

}  // namespace hogel::camera::speckle_free
