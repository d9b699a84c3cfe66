// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <complex>

#include "hogel/direct/scene_points.h"

namespace hogel::direct {

/// A row of samples of a tile: the position of the first one and the distance between them.
struct SampleRow {
    double x = 0, y = 0, pitch = 0;
};

/// Adds a point's spherical wave at all samples of a row, except where `hidden` is true (null: nowhere) and where the
/// wave is too steep for the grid's pitch. Plain and fast twins agree to rounding.
void add_wave_plain(const ScenePoint& point, const FieldGrid& grid, const SampleRow& row, const bool* hidden,
                    double* real, double* imaginary);
extern decltype(add_wave_plain)& add_wave;

/// The exact sum of points' waves over one tile.
class ExactSums {
  public:
    ExactSums(const FieldGrid& grid, const Region& region) : grid_(grid), region_(region) {
        const Grid cut = part(grid.plane, region);
        middle_ = {cut.center_x, cut.center_y, 0};
        reach_x_ = 0.5 * cut.size_x();
        reach_y_ = 0.5 * cut.size_y();
    }

    Vec3 middle() const { return middle_; }  ///< of the tile
    double reach_x() const { return reach_x_; }
    double reach_y() const { return reach_y_; }
    /// Whether light of a point reaches the tile, judged at the tile's nearest position.
    bool reached_from(Vec3 point) const {
        const Vec3 nearest{std::clamp(point.x, middle_.x - reach_x_, middle_.x + reach_x_),
                           std::clamp(point.y, middle_.y - reach_y_, middle_.y + reach_y_), 0};
        return passage(point, nearest, grid_).has_value();
    }

    void add(const ScenePoint& point) {
        for (std::size_t row = 0; row < region_.height; ++row)
            add_wave(point, grid_, row_of(row), nullptr, real_[row].data(), imaginary_[row].data());
    }
    /// As add(), but tests visibility by a ray from the point to each sample that its light may reach.
    void add_visible(const ScenePoint& point, const Visibility& visibility);

    std::complex<float> operator()(std::size_t row, std::size_t column) const {
        return std::complex<float>(std::complex<double>(real_[row][column], imaginary_[row][column]));
    }

  private:
    SampleRow row_of(std::size_t row) const {
        return {grid_.plane.x(static_cast<double>(region_.x0)), grid_.plane.y(static_cast<double>(region_.y0 + row)),
                grid_.plane.pitch_x};
    }

    const FieldGrid& grid_;
    Region region_;
    Vec3 middle_;
    double reach_x_, reach_y_;
    std::array<std::array<double, tile_side>, tile_side> real_{}, imaginary_{};
};

}  // namespace hogel::direct
