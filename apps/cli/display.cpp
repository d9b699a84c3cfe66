// SPDX-License-Identifier: Apache-2.0
#include "display.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogel::cli {

Image logarithmic(const Image& intensities) {
    constexpr float decades = 4;
    Image result = intensities;
    const float brightest = *std::max_element(result.pixels.elements().begin(), result.pixels.elements().end());
    for (float& value : result.pixels.elements())
        value = value > 0 ? srgb_decode(std::max(0.0f, 1 + std::log10(value / brightest) / decades)) : 0;
    return result;
}

Image phases(View<const std::complex<float>, 2> field) {
    Image result(field.extent(1), field.extent(0), 1);
    for (std::size_t i = 0; i < field.size(); ++i)
        result.pixels.data()[i] =
            srgb_decode(0.5f + 0.5f * std::arg(field.data()[i]) / static_cast<float>(std::numbers::pi));
    return result;
}

}  // namespace hogel::cli
