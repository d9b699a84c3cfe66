// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/scaled_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hogel::exchange {
namespace {

// Adds the samples that one output sample covers, weighted by the covered fractions of its extent. Samples are vectors
// of `length` numbers.
void add_covered(const float* in, std::size_t samples, std::size_t length, std::size_t index, std::size_t count,
                 float* out) {
    const double extent = static_cast<double>(samples) / static_cast<double>(count),
                 begin = static_cast<double>(index) * extent, end = begin + extent;
    for (auto i = static_cast<std::size_t>(begin); i < samples && static_cast<double>(i) < end; ++i) {
        const double covered = std::min(end, static_cast<double>(i + 1)) - std::max(begin, static_cast<double>(i));
        const auto weight = static_cast<float>(covered / extent);
        for (std::size_t n = 0; n < length; ++n) out[n] += weight * in[i * length + n];
    }
}

}  // namespace

Array<float, 3> scaled_view(View<const float, 3> picture, std::size_t height, std::size_t width) {
    const std::size_t rows = picture.extent(0), columns = picture.extent(1), channels = picture.extent(2);
    Array<float, 3> out({height, width, channels});
    if (rows == height && columns == width) {
        std::ranges::copy(picture.elements(), out.data());
        return out;
    }
    std::vector<float> row(columns * channels);
    for (std::size_t y = 0; y < height; ++y) {
        std::ranges::fill(row, 0.0f);
        add_covered(&picture(0, 0, 0), rows, row.size(), y, height, row.data());
        for (std::size_t x = 0; x < width; ++x) add_covered(row.data(), columns, channels, x, width, &out(y, x, 0));
    }
    return out;
}

}  // namespace hogel::exchange
