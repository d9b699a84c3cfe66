// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/diffraction.h"

#include <algorithm>
#include <cmath>

namespace hogel::stereogram {

double steepest_sine(const LightFieldGrid& light_field) {
    const double edge = std::max(std::abs(light_field.center_u()) + light_field.half_u(),
                                 std::abs(light_field.center_v()) + light_field.half_v());
    return light_field.has_frequencies() ? std::min(1.0, edge - 0.5 * light_field.step_u())
                                         : edge / std::sqrt(1 + edge * edge);
}

std::size_t samples_per_hogel(const LightFieldGrid& light_field, double pitch) {
    return static_cast<std::size_t>(std::max(1.0, std::round(light_field.pitch / pitch)));
}

double max_pitch(const LightFieldGrid& light_field, double wavelength) {
    return wavelength / (2 * steepest_sine(light_field));
}

}  // namespace hogel::stereogram
