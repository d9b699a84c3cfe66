// SPDX-License-Identifier: Apache-2.0
#include "view/heat.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hogel::view {
namespace {

// Seven colours of Matplotlib's colour map viridis (van der Walt and Smith, public domain), sRGB values.
constexpr std::array<std::array<float, 3>, 7> colours{{{0.267f, 0.005f, 0.329f},
                                                       {0.268f, 0.228f, 0.512f},
                                                       {0.191f, 0.407f, 0.556f},
                                                       {0.128f, 0.567f, 0.551f},
                                                       {0.208f, 0.719f, 0.473f},
                                                       {0.565f, 0.842f, 0.262f},
                                                       {0.993f, 0.906f, 0.144f}}};

}  // namespace

Image heat_map(const Array<double, 2>& numbers, double low, double high) {
    Image picture(numbers.extent(1), numbers.extent(0), 3);
    const double range = high > low ? high - low : 1;
    for (std::size_t y = 0; y < picture.height(); ++y)
        for (std::size_t x = 0; x < picture.width(); ++x) {
            const double position = std::clamp((numbers(y, x) - low) / range, 0.0, 1.0) * (colours.size() - 1);
            const auto i = std::min(static_cast<std::size_t>(position), colours.size() - 2);
            const auto fraction = static_cast<float>(position - static_cast<double>(i));
            for (std::size_t c = 0; c < 3; ++c)
                picture.pixels(y, x, c) = srgb_decode(std::lerp(colours[i][c], colours[i + 1][c], fraction));
        }
    return picture;
}

}  // namespace hogel::view
