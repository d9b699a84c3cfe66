// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/rays/ray_kernels.h"

#include "hogel/core/half.h"
#include "hogel/lightfield/interpolation.h"

namespace hogel::camera::rays {

void sample_between_plain(const HogelRows& hogels, const LinePositions& directions, std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto at = i * hogels.hogel + static_cast<std::size_t>(directions.low[i]);
        const float* top = hogels.top + at;
        const float* bottom = hogels.bottom + at;
        const float above = lightfield::mix(top[0], top[hogels.next], directions.high_weight[i]);
        const float below = lightfield::mix(bottom[0], bottom[hogels.next], directions.high_weight[i]);
        out[i] = lightfield::mix(above, below, hogels.bottom_weight);
    }
}

void sample_along_plain(const FourDirections<float>& from, std::span<const float> right_weight, float bottom_weight,
                        std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float above = lightfield::mix(from.top_left[i], from.top_right[i], right_weight[i]);
        const float below = lightfield::mix(from.bottom_left[i], from.bottom_right[i], right_weight[i]);
        out[i] = lightfield::mix(above, below, bottom_weight);
    }
}

void sample_along_plain(const FourDirections<std::uint16_t>& from, std::span<const float> right_weight,
                        float bottom_weight, std::span<float> out) {
    using core::float_of;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float above = lightfield::mix(float_of(from.top_left[i]), float_of(from.top_right[i]), right_weight[i]);
        const float below =
            lightfield::mix(float_of(from.bottom_left[i]), float_of(from.bottom_right[i]), right_weight[i]);
        out[i] = lightfield::mix(above, below, bottom_weight);
    }
}

void mix_lines_plain(std::span<const float> a, std::span<const float> b, float weight, std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = lightfield::mix(a[i], b[i], weight);
}

void add_between_plain(std::span<const float> line, std::size_t next, const LinePositions& positions,
                       std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto low = static_cast<std::size_t>(positions.low[i]);
        out[i] += lightfield::mix(line[low], line[low + next], positions.high_weight[i]);
    }
}

}  // namespace hogel::camera::rays
