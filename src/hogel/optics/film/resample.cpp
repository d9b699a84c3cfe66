// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/film/resample.h"

#include <cmath>

namespace hogel::optics::film {

void resample_tangents_plain(std::span<const std::complex<float>> line, const TangentPlaces& places,
                             const InterpolationTable& table, std::span<std::complex<float>> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double s = places.first + static_cast<double>(i) * places.step;
        out[i] =
            table.at(line.data(), line.size(), places.offset + places.scale * (s / std::sqrt(places.square - s * s)));
    }
}

}  // namespace hogel::optics::film
