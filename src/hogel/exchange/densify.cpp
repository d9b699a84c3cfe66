// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/densify.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hogel/error.h"

namespace hogel::exchange {
namespace {

// Disparity tolerance, pixels, of a visible surface; weights of sources where it is hidden or outside.
constexpr double same_surface = 0.5;
constexpr float hidden_weight = 1e-4f, outside_weight = 1e-6f;

// Returns the weights of four samples around a fraction between the middle two (Catmull-Rom).
std::array<float, 4> cubic(float f) {
    return {0.5f * f * (-1 + f * (2 - f)), 0.5f * (2 + f * f * (3 * f - 5)), 0.5f * f * (1 + f * (4 - 3 * f)),
            0.5f * f * f * (f - 1)};
}

template <class T>
void add_sample(const Array<T, 3>& from, double x, double y, float weight, float* sum) {
    const auto x0 = static_cast<long>(std::floor(x)), y0 = static_cast<long>(std::floor(y));
    const std::array<float, 4> wx = cubic(static_cast<float>(x - static_cast<double>(x0))),
                               wy = cubic(static_cast<float>(y - static_cast<double>(y0)));
    const auto height = static_cast<long>(from.extent(0)), width = static_cast<long>(from.extent(1));
    const std::size_t channels = from.extent(2);
    for (long j = 0; j < 4; ++j) {
        const auto row = static_cast<std::size_t>(std::clamp(y0 + j - 1, 0L, height - 1));
        for (long i = 0; i < 4; ++i) {
            const auto column = static_cast<std::size_t>(std::clamp(x0 + i - 1, 0L, width - 1));
            const float w = weight * wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)];
            const T* pixel = &from(row, column, 0);
            for (std::size_t c = 0; c < channels; ++c) sum[c] += w * static_cast<float>(pixel[c]);
        }
    }
}

template <class T>
T rounded(float value, const T*) {
    if constexpr (std::is_same_v<T, float>)
        return value;
    else
        return static_cast<T>(std::lround(std::clamp(value, 0.0f, static_cast<float>(std::numeric_limits<T>::max()))));
}

class DensifiedPictures final : public ViewPictures {
  public:
    DensifiedPictures(const ViewSet& set, std::shared_ptr<const Disparities> disparities, std::size_t factor,
                      double memory)
        : set_(set),
          disparities_(std::move(disparities)),
          factor_(factor),
          kept_(static_cast<std::size_t>(std::clamp(
              memory / (static_cast<double>(set.width * set.height * set.channels) * (set.bits <= 8 ? 1 : 4)), 8.0,
              static_cast<double>(set.rows * set.columns) + 8))) {}

    image::Picture read(std::size_t row, std::size_t column) const override {
        if (row % factor_ == 0 && column % factor_ == 0) return *source(row / factor_, column / factor_);
        const std::vector<Source> sources = sources_of(row, column);
        return std::visit(
            [&](const auto& samples) { return between<std::remove_cvref_t<decltype(samples)>>(row, column, sources); },
            sources.front().picture->samples);
    }

    std::string name(std::size_t row, std::size_t column) const override {
        if (row % factor_ == 0 && column % factor_ == 0) return set_.pictures->name(row / factor_, column / factor_);
        return fmt::format("between {} and the next views", set_.pictures->name(row / factor_, column / factor_));
    }

  private:
    // A view near the requested one.
    struct Source {
        double across = 0, down = 0;  // offset from the requested view
        float weight = 0;
        std::shared_ptr<const image::Picture> picture;
        std::shared_ptr<const DisparityMap> map;
    };

    std::shared_ptr<const image::Picture> source(std::size_t row, std::size_t column) const {
        return kept_.get(row * set_.columns + column,
                         [&] { return std::make_shared<const image::Picture>(set_.pictures->read(row, column)); });
    }

    std::vector<Source> sources_of(std::size_t row, std::size_t column) const {
        const double y = static_cast<double>(row) / static_cast<double>(factor_),
                     x = static_cast<double>(column) / static_cast<double>(factor_);
        std::vector<Source> sources;
        for (std::size_t r = row / factor_; r <= (row + factor_ - 1) / factor_; ++r)
            for (std::size_t c = column / factor_; c <= (column + factor_ - 1) / factor_; ++c) {
                const double down = static_cast<double>(r) - y, across = static_cast<double>(c) - x;
                sources.push_back({across, down, static_cast<float>((1 - std::abs(down)) * (1 - std::abs(across))),
                                   source(r, c), disparities_->at(static_cast<double>(r), static_cast<double>(c))});
                if (sources.back().picture->samples.index() != sources.front().picture->samples.index())
                    fail_source(set_.pictures->name(r, c),
                                "its samples are of another kind than those of its neighbours");
            }
        return sources;
    }

    // Returns the visibility weight of a point at (x, y) in a source, by the source's own disparity.
    float seen(const Source& from, double x, double y, float disparity) const {
        const DisparityMap& map = *from.map;
        const double inside_x = static_cast<double>(map.extent(1)) - 1,
                     inside_y = static_cast<double>(map.extent(0)) - 1;
        if (x < -0.5 || y < -0.5 || x > inside_x + 0.5 || y > inside_y + 0.5) return outside_weight;
        const float local = map(static_cast<std::size_t>(std::lround(std::clamp(y, 0.0, inside_y))),
                                static_cast<std::size_t>(std::lround(std::clamp(x, 0.0, inside_x))));
        return std::abs(local - disparity) < same_surface ? 1 : hidden_weight;
    }

    template <class Samples>
    image::Picture between(std::size_t row, std::size_t column, const std::vector<Source>& sources) const {
        const std::shared_ptr<const DisparityMap> map =
            disparities_->at(static_cast<double>(row) / static_cast<double>(factor_),
                             static_cast<double>(column) / static_cast<double>(factor_));
        for (const Source& from : sources)
            if (std::get<Samples>(from.picture->samples).shape() != Shape<3>{set_.height, set_.width, set_.channels})
                fail_source(name(row, column), "its size differs from that of the first view");
        Samples out({set_.height, set_.width, set_.channels});
        std::vector<float> sum(set_.channels);
        for (std::size_t y = 0; y < set_.height; ++y)
            for (std::size_t x = 0; x < set_.width; ++x) {
                const float d = (*map)(y, x);
                std::ranges::fill(sum, 0.0f);
                float weights = 0;
                for (const Source& from : sources) {
                    // `across` views to the right, the point is across · d pixels to the left.
                    const double at_x = static_cast<double>(x) - static_cast<double>(d) * from.across;
                    const double at_y =
                        static_cast<double>(y) - static_cast<double>(d) * from.down * set_.geometry.spacing_ratio;
                    const float weight = from.weight * seen(from, at_x, at_y, d);
                    add_sample(std::get<Samples>(from.picture->samples), at_x, at_y, weight, sum.data());
                    weights += weight;
                }
                for (std::size_t c = 0; c < set_.channels; ++c) out(y, x, c) = rounded(sum[c] / weights, out.data());
            }
        return {std::move(out), {}, sources.front().picture->max_code};
    }

    ViewSet set_;
    std::shared_ptr<const Disparities> disparities_;
    std::size_t factor_;
    mutable work::LruCache<std::size_t, image::Picture> kept_;
};

}  // namespace

ViewSet densified(ViewSet set, std::shared_ptr<const Disparities> disparities, std::size_t factor, double memory) {
    auto pictures = std::make_shared<DensifiedPictures>(set, std::move(disparities), factor, memory);
    set.pictures = std::move(pictures);
    set.columns = (set.columns - 1) * factor + 1;
    set.rows = (set.rows - 1) * factor + 1;
    return set;
}

void densify(Placement& placement, std::size_t factor) {
    const auto f = static_cast<double>(factor);
    LightFieldGrid& grid = placement.grid;
    const double step_u = grid.step_u() / f, step_v = grid.step_v() / f;
    const bool one_row = grid.directions_v == 1, one_column = grid.directions_u == 1;
    grid.directions_u = (grid.directions_u - 1) * factor + 1;
    grid.directions_v = (grid.directions_v - 1) * factor + 1;
    if (!one_column) grid.range().half_u = 0.5 * static_cast<double>(grid.directions_u) * step_u;
    if (!one_row) grid.range().half_v = 0.5 * static_cast<double>(grid.directions_v) * step_v;
    placement.spacing /= f;
    placement.spacing_y /= f;
    placement.shear.dx /= f;
    placement.shear.dy /= f;
}

}  // namespace hogel::exchange
