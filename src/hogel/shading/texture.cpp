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

using Wrap = TextureSampling::Wrap;

/// The two of n samples next to a position, and the weight of the second.
struct Neighbours {
    std::size_t first, second;
    float weight;
};

Neighbours repeated(double position, std::size_t n) {
    const double scaled = (position - std::floor(position)) * static_cast<double>(n) - 0.5;
    const double low = std::floor(scaled);
    const auto first = static_cast<std::size_t>(low < 0 ? low + static_cast<double>(n) : low);
    return {std::min(first, n - 1), first + 1 < n ? first + 1 : 0, static_cast<float>(scaled - low)};
}

Neighbours neighbours(double position, std::size_t n, Wrap wrap) {
    if (wrap == Wrap::repeat) return repeated(position, n);
    if (wrap == Wrap::mirror) {
        position -= 2 * std::floor(0.5 * position);
        if (position > 1) position = 2 - position;
    }
    // At its border a picture meets its mirror image with equal texels, so repeating the last texel is correct.
    const double last = static_cast<double>(n - 1),
                 scaled = std::clamp(position, 0.0, 1.0) * static_cast<double>(n) - 0.5;
    const double low = std::floor(scaled);
    return {static_cast<std::size_t>(std::clamp(low, 0.0, last)),
            static_cast<std::size_t>(std::clamp(low + 1, 0.0, last)), static_cast<float>(scaled - low)};
}

/// The four texels around a point. With `nearest` the weights select one of them.
struct Around {
    Neighbours column, row;

    Around(const Image& image, TextureCoordinate coordinate, const TextureSampling& sampling, bool nearest)
        : column(neighbours(coordinate.u, image.width(), sampling.wrap_u)),
          row(neighbours(1.0 - coordinate.v, image.height(), sampling.wrap_v)) {
        if (!nearest) return;
        column.weight = column.weight < 0.5f ? 0.0f : 1.0f;
        row.weight = row.weight < 0.5f ? 0.0f : 1.0f;
    }
    float mix(float a, float b, float c, float d) const {
        const float top = a + column.weight * (b - a), bottom = c + column.weight * (d - c);
        return top + row.weight * (bottom - top);
    }
};

Rgb interpolate(const Image& image, TextureCoordinate coordinate, const TextureSampling& sampling, bool nearest) {
    const Around around(image, coordinate, sampling, nearest);
    const auto& [column, row] = around;
    const auto a = texel(image, row.first, column.first), b = texel(image, row.first, column.second);
    const auto c = texel(image, row.second, column.first), d = texel(image, row.second, column.second);
    std::array<float, 3> mixed;
    for (std::size_t i = 0; i < 3; ++i) mixed[i] = around.mix(a[i], b[i], c[i], d[i]);
    return {mixed[0], mixed[1], mixed[2]};
}

float interpolate_alpha(const Image& image, TextureCoordinate coordinate, const TextureSampling& sampling,
                        bool nearest) {
    const Around around(image, coordinate, sampling, nearest);
    const auto& [column, row] = around;
    constexpr std::size_t alpha = 3;
    return around.mix(image.pixels(row.first, column.first, alpha), image.pixels(row.first, column.second, alpha),
                      image.pixels(row.second, column.first, alpha), image.pixels(row.second, column.second, alpha));
}

/// Samples (of n) that sample i of m covers, m <= n, as weights with sum 1.
struct Covered {
    std::size_t first;
    std::array<float, 4> weights;
};

Covered covered(std::size_t i, std::size_t m, std::size_t n) {
    const double scale = static_cast<double>(n) / static_cast<double>(m), low = scale * static_cast<double>(i);
    const double high = std::min(low + scale, static_cast<double>(n));  // the sum may be rounded up
    Covered result{static_cast<std::size_t>(low), {}};
    for (std::size_t k = 0; k < result.weights.size(); ++k) {
        const double position = static_cast<double>(result.first + k);
        result.weights[k] =
            static_cast<float>(std::max(0.0, std::min(high, position + 1) - std::max(low, position)) / scale);
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

Texture::Texture(std::shared_ptr<const Image> finest, bool filtered, const TextureSampling& sampling)
    : sampling_(sampling), finest_(std::move(finest)) {
    if (!filtered) return;
    for (const Image* last = finest_.get(); last->width() > 1 || last->height() > 1; last = &coarser_.back())
        coarser_.push_back(halved(*last));
}

template <class Value, class Interpolate>
Value Texture::between_levels(double width, const Interpolate& interpolate_level) const {
    // Interpolation within a level averages over about one texel. For widths in between, two levels are blended.
    const double level = width > 1 ? std::min(std::log2(width), static_cast<double>(coarser_.size())) : 0;
    const auto fine = static_cast<std::size_t>(level);
    const auto weight = static_cast<float>(level - static_cast<double>(fine));
    const Value first = interpolate_level(fine == 0 ? *finest_ : coarser_[fine - 1], fine == 0 && sampling_.nearest);
    if (weight == 0) return first;
    return (1 - weight) * first + weight * interpolate_level(coarser_[fine], false);
}

Rgb Texture::sample(TextureCoordinate at, double width) const {
    return between_levels<Rgb>(
        width, [&](const Image& level, bool nearest) { return interpolate(level, at, sampling_, nearest); });
}

float Texture::alpha(TextureCoordinate at, double width) const {
    if (finest_->channels() < 4) return 1;
    return between_levels<float>(
        width, [&](const Image& level, bool nearest) { return interpolate_alpha(level, at, sampling_, nearest); });
}

}  // namespace hogel
