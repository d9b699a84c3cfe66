// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/film/kernels.h"

#include <algorithm>
#include <cmath>

#include "hogel/optics/film/interpolation.h"

namespace hogel::optics::film {

void sum_down_columns_plain(const float* values, std::size_t stride, std::size_t height, const ColumnPoints& points,
                            std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = 0;
        for (const double scale : points.scales)
            out[i] += smooth_at<TwelvePoint>(height, points.offset + scale * points.slopes[i],
                                             [&](std::size_t j) { return values[j * stride + i]; });
    }
}

void add_along_line_plain(std::span<const float> line, const LinePlaces& places, float weight, std::span<float> out) {
    for (std::size_t k = 0; k < out.size(); ++k) {
        const double d = places.first + places.pitch * static_cast<double>(k), r = std::sqrt(d * d + places.square);
        const float value = smooth_at<TwelvePoint>(line.size(), places.offset + places.scale * (d / r),
                                                   [&](std::size_t i) { return line[i]; });
        out[k] += weight * static_cast<float>(r * r * r) * std::max(value, 0.0f);
    }
}

}  // namespace hogel::optics::film
