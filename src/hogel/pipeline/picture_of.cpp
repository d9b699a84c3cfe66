// SPDX-License-Identifier: Apache-2.0
// Pictures of the samples of fields.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/core/stop_scope.h"
#include "hogel/pipeline.h"

namespace hogel {
namespace {

using Complex = std::complex<float>;

// Returns 1 / the largest modulus, or 0 for a zero field.
float scale_of(View<const Complex, 2> samples) {
    float largest = 0;
    for (const Complex& value : samples.elements()) largest = std::max(largest, std::abs(value));
    return largest > 0 ? 1 / largest : 0;
}

}  // namespace

Image picture_of(View<const Complex, 2> samples, FieldQuantity quantity) {
    Image picture(samples.extent(1), samples.extent(0), 1);
    const auto show = [&](const auto& value_of) {
        std::ranges::transform(samples.elements(), picture.pixels.elements().begin(), value_of);
    };
    switch (quantity) {
        case FieldQuantity::intensity:
            show([](const Complex& value) { return std::norm(value); });
            break;
        case FieldQuantity::amplitude:
            show([](const Complex& value) { return std::sqrt(std::norm(value)); });
            break;
        case FieldQuantity::phase:
            show([](const Complex& value) {
                return srgb_decode(0.5f + 0.5f * std::arg(value) / static_cast<float>(std::numbers::pi));
            });
            break;
        case FieldQuantity::real:
            show([scale = scale_of(samples)](const Complex& value) {
                return srgb_decode(0.5f + 0.5f * scale * value.real());
            });
            break;
    }
    return picture;
}

Image picture_of(const FieldSource& field, FieldQuantity quantity, std::size_t look, const Progress& progress) {
    const core::StopScope scope(progress);
    Field samples(field.grid());
    copy(field, samples, look, progress);
    Image picture = picture_of(samples.samples.view(), quantity);
    picture.provenance = field.provenance();
    return picture;
}

Image logarithmic(const Image& intensities) {
    constexpr float decades = 4;
    Image result = intensities;
    const float brightest = *std::max_element(result.pixels.elements().begin(), result.pixels.elements().end());
    for (float& value : result.pixels.elements())
        value = value > 0 ? srgb_decode(std::max(0.0f, 1 + std::log10(value / brightest) / decades)) : 0;
    return result;
}

}  // namespace hogel
