// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <complex>

#include "hogel/direct/scene_points.h"

namespace hogel::direct {

/// A row of samples of a tile: position of its first sample and pitch, metres.
struct SampleRow {
    double x = 0, y = 0, pitch = 0;
};

/// Adds a point's spherical wave to the tile_side samples of a row, given by their real and imaginary parts. Skips
/// samples with hidden[i] (`hidden` may be null), and samples at which the wave exceeds half a cycle per pitch in x or
/// y (too_steep()). The plain and the fast version agree to rounding.
void add_wave_plain(const ScenePoint& point, const FieldGrid& grid, const SampleRow& row, const bool* hidden,
                    double* real, double* imaginary);
extern decltype(add_wave_plain)& add_wave;

class ExactSums {
  public:
    ExactSums(const FieldGrid& grid, const Region& region) : grid_(grid), region_(region) {
        const Grid tile = part(grid.plane, region);
        middle_ = {tile.center_x, tile.center_y, 0};
        half_x_ = 0.5 * tile.size_x();
        half_y_ = 0.5 * tile.size_y();
    }

    Vec3 middle() const { return middle_; }    ///< of the tile, metres
    double half_x() const { return half_x_; }  ///< half the tile's width, metres
    double half_y() const { return half_y_; }
    /// Returns whether a point's light reaches the tile, tested at the tile's nearest position.
    bool reached_from(Vec3 point) const {
        const Vec3 nearest{std::clamp(point.x, middle_.x - half_x_, middle_.x + half_x_),
                           std::clamp(point.y, middle_.y - half_y_, middle_.y + half_y_), 0};
        return passage(point, nearest, grid_).has_value();
    }

    void add(const ScenePoint& point) {
        for (std::size_t row = 0; row < region_.height; ++row)
            add_wave(point, grid_, row_of(row), nullptr, real_[row].data(), imaginary_[row].data());
    }
    /// As add(), but tests visibility by a ray from the point to each sample that is not too steep.
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
    double half_x_, half_y_;
    std::array<std::array<double, tile_side>, tile_side> real_{}, imaginary_{};
};

}  // namespace hogel::direct
