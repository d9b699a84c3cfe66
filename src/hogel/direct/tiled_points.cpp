// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hogel/core/stop_scope.h"
#include "hogel/direct/exact_sums.h"
#include "hogel/direct/scene_points.h"
#include "hogel/stereogram/unit_roots.h"

namespace hogel::direct {
namespace {

constexpr std::size_t side = tile_side;
constexpr double max_cycles_wrong = 0.01;  // a mean error of a quarter of a degree

// Whether a point's light reaches no sample, some, or all samples of a tile.
enum class Zone { dark, edge, active };

// e^{2πi (a t + b t²)} at t = −(n−1)/2 … (n−1)/2 pitches, as real and imaginary parts.
struct Chirp {
    std::array<float, side> real{}, imaginary{};

    Chirp(const stereogram::UnitRoots& roots, double first_order, double second_order, std::size_t n, double pitch) {
        for (std::size_t i = 0; i < n; ++i) {
            const double t = (static_cast<double>(i) - 0.5 * static_cast<double>(n - 1)) * pitch;
            const std::complex<float> root = roots(t * (first_order + second_order * t));
            real[i] = root.real();
            imaginary[i] = root.imag();
        }
    }
};

// Computes a point's wave over one tile. The path is expanded around the tile's middle to second order without the
// mixed term, so the wave is a product of a column and a row factor, both from a table of roots of unity.
class Tile {
  public:
    Tile(const stereogram::UnitRoots& roots, const FieldGrid& grid, const Region& region)
        : roots_(roots),
          grid_(grid),
          region_(region),
          exact_(grid, region),
          middle_(exact_.middle()),
          half_x_(exact_.half_x()),
          half_y_(exact_.half_y()) {}
    Vec3 middle() const { return middle_; }

    // Tests the tile's corners and its position nearest to the point.
    Zone zone(Vec3 point) const {
        if (!exact_.reached_from(point)) return Zone::dark;
        for (const double x : {-half_x_, half_x_})
            for (const double y : {-half_y_, half_y_})
                if (!passage(point, middle_ + Vec3{x, y, 0}, grid_)) return Zone::edge;
        return Zone::active;
    }

    void add(const ScenePoint& point, const Passage& ray) {
        const double path = ray.path, gx = ray.direction.x, gy = ray.direction.y;
        const double curve_x = (1 - gx * gx) / (2 * path), curve_y = (1 - gy * gy) / (2 * path);
        const double k = 1 / grid_.wavelength;
        const double mixed = std::abs(gx * gy / path) * half_x_ * half_y_;
        const double third = (std::abs(gx) * std::abs(curve_x) * std::pow(half_x_, 3) +
                              std::abs(gy) * std::abs(curve_y) * std::pow(half_y_, 3)) /
                             std::abs(path);
        const double fourth = std::pow(half_x_ * half_x_ + half_y_ * half_y_, 2) / (8 * std::pow(std::abs(path), 3));
        if (k * (mixed + third + fourth) > max_cycles_wrong) return add_exactly(point);
        const Chirp x(roots_, k * gx, k * curve_x, region_.width, grid_.plane.pitch_x);
        // Row indices increase downwards.
        const Chirp y(roots_, -k * gy, k * curve_y, region_.height, grid_.plane.pitch_y);
        const std::complex<float> factor = static_cast<float>(modulus(point, ray)) * roots_(k * path + point.cycles);
        for (std::size_t row = 0; row < region_.height; ++row) {
            const std::complex<float> start = factor * std::complex<float>(y.real[row], y.imaginary[row]);
            const float real = start.real(), imaginary = start.imag();
            for (std::size_t column = 0; column < side; ++column) {
                real_[row][column] += real * x.real[column] - imaginary * x.imaginary[column];
                imaginary_[row][column] += real * x.imaginary[column] + imaginary * x.real[column];
            }
        }
    }

    void write(View<std::complex<float>, 2> values) const {
        for (std::size_t row = 0; row < region_.height; ++row)
            for (std::size_t column = 0; column < region_.width; ++column)
                values(row, column) =
                    std::complex<float>(real_[row][column], imaginary_[row][column]) + exact_(row, column);
    }

    // Adds a point sample by sample if it is too near for the expansion or reaches only part of the tile.
    void add_exactly(const ScenePoint& point) { exact_.add(point); }

  private:
    const stereogram::UnitRoots& roots_;
    const FieldGrid& grid_;
    Region region_;
    ExactSums exact_;
    Vec3 middle_;
    double half_x_, half_y_;
    std::array<std::array<float, side>, side> real_{}, imaginary_{};
};

}  // namespace

// Points with occlusion by one ray for each point and tile of 32×32 samples.
Field tiled_points(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                   const Progress& progress) {
    const core::StopScope scope(progress);
    const Visibility visibility(scene);
    const std::vector<ScenePoint> points = surface_points(scene, grid, options);
    const stereogram::UnitRoots roots;
    return sum_over_tiles(grid, progress, [&](const Region& region, View<std::complex<float>, 2> values) {
        Tile tile(roots, grid, region);
        for (const ScenePoint& point : points) {
            core::throw_if_stopped();
            const Zone zone = tile.zone(point.position);
            if (zone == Zone::dark) continue;
            const Passage ray = unlimited_passage(point.position, tile.middle());
            if (!visibility.is_visible(point.surface, ray.direction)) continue;
            zone == Zone::active ? tile.add(point, ray) : tile.add_exactly(point);
        }
        tile.write(values);
    });
}

}  // namespace hogel::direct
