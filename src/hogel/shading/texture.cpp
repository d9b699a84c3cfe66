// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hogel {
namespace {

std::array<float, 3> texel(const Image& image, std::size_t row, std::size_t column) {
    if (image.channels() == 1) {
        const float grey = image.pixels(row, column, 0);
        return {grey, grey, grey};
    }
    return {image.pixels(row, column, 0), image.pixels(row, column, 1), image.pixels(row, column, 2)};
}

/// The two samples of n next to a position in 0..1 (wrapped around), and the weight of the second.
struct Neighbours {
    std::size_t first, second;
    float weight;
};

Neighbours neighbours(double position, std::size_t n) {
    const double at = (position - std::floor(position)) * static_cast<double>(n) - 0.5;
    const double low = std::floor(at);
    const auto first = static_cast<std::size_t>(low < 0 ? low + static_cast<double>(n) : low);
    return {std::min(first, n - 1), first + 1 < n ? first + 1 : 0, static_cast<float>(at - low)};
}

Rgb interpolate(const Image& image, TextureCoordinate at) {
    const Neighbours column = neighbours(at.u, image.width()), row = neighbours(1.0 - at.v, image.height());
    const auto a = texel(image, row.first, column.first), b = texel(image, row.first, column.second);
    const auto c = texel(image, row.second, column.first), d = texel(image, row.second, column.second);
    std::array<float, 3> mixed;
    for (std::size_t i = 0; i < 3; ++i) {
        const float top = a[i] + column.weight * (b[i] - a[i]), bottom = c[i] + column.weight * (d[i] - c[i]);
        mixed[i] = top + row.weight * (bottom - top);
    }
    return {mixed[0], mixed[1], mixed[2]};
}

/// The samples of n that sample i of m covers, m <= n, as weights that sum to one.
struct Covered {
    std::size_t first;
    std::array<float, 4> weights;
};

Covered covered(std::size_t i, std::size_t m, std::size_t n) {
    const double scale = static_cast<double>(n) / static_cast<double>(m), low = scale * static_cast<double>(i);
    const double high = low + scale;
    Covered result{static_cast<std::size_t>(low), {}};
    for (std::size_t k = 0; k < result.weights.size(); ++k) {
        const double from = static_cast<double>(result.first + k);
        result.weights[k] = static_cast<float>(std::max(0.0, std::min(high, from + 1) - std::max(low, from)) / scale);
    }
    return result;
}

Image halved(const Image& fine) {
    Image coarse(std::max<std::size_t>(1, fine.width() / 2), std::max<std::size_t>(1, fine.height() / 2),
                 fine.channels());
    for (std::size_t row = 0; row < coarse.height(); ++row)
        for (std::size_t column = 0; column < coarse.width(); ++column) {
            const Covered rows = covered(row, coarse.height(), fine.height());
            const Covered columns = covered(column, coarse.width(), fine.width());
            for (std::size_t c = 0; c < fine.channels(); ++c) {
                float sum = 0;
                for (std::size_t k = 0; k < 4; ++k)
                    for (std::size_t i = 0; i < 4; ++i)
                        if (const float weight = rows.weights[k] * columns.weights[i]; weight > 0)
                            sum += weight * fine.pixels(rows.first + k, columns.first + i, c);
                coarse.pixels(row, column, c) = sum;
            }
        }
    return coarse;
}

}  // namespace

Texture::Texture(std::shared_ptr<const Image> finest, bool filtered) : finest_(std::move(finest)) {
    if (!filtered) return;
    for (const Image* last = finest_.get(); last->width() > 1 || last->height() > 1; last = &coarser_.back())
        coarser_.push_back(halved(*last));
}

Rgb Texture::sample(TextureCoordinate at, double width) const {
    // Interpolation within a level averages over about one of its texels; two levels are blended for widths between
    // them.
    const double level = width > 1 ? std::min(std::log2(width), static_cast<double>(coarser_.size())) : 0;
    const auto fine = static_cast<std::size_t>(level);
    const auto weight = static_cast<float>(level - static_cast<double>(fine));
    const Rgb first = interpolate(fine == 0 ? *finest_ : coarser_[fine - 1], at);
    if (weight == 0) return first;
    return (1 - weight) * first + weight * interpolate(coarser_[fine], at);
}

}  // namespace hogel
