// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "hogel/core/stop_scope.h"
#include "hogel/direct/exact_sums.h"

namespace hogel::direct {
namespace {

// Sums the points' spherical waves tile by tile; add(sums of a tile, point) adds one point.
template <class Add>
Field sum_exactly(const std::vector<ScenePoint>& points, const FieldGrid& grid, const Progress& progress, Add add) {
    return sum_over_tiles(grid, progress, [&](const Region& region, View<std::complex<float>, 2> values) {
        ExactSums sums(grid, region);
        for (const ScenePoint& point : points) {
            core::throw_if_stopped();
            if (sums.reached_from(point.position)) add(sums, point);
        }
        for (std::size_t row = 0; row < region.height; ++row)
            for (std::size_t column = 0; column < region.width; ++column) values(row, column) = sums(row, column);
    });
}

void add_all(ExactSums& sums, const ScenePoint& point) { sums.add(point); }

}  // namespace

void add_wave_plain(const ScenePoint& point, const FieldGrid& grid, const SampleRow& row, const bool* hidden,
                    double* real, double* imaginary) {
    for (std::size_t i = 0; i < tile_side; ++i) {
        const auto ray = passage(point.position, {row.x + static_cast<double>(i) * row.pitch, row.y, 0}, grid);
        if (!ray || (hidden && hidden[i])) continue;
        const double cycles = ray->path / grid.wavelength + point.cycles;
        const std::complex<double> wave =
            std::polar(modulus(point, *ray), 2 * std::numbers::pi * (cycles - std::round(cycles)));
        real[i] += wave.real();
        imaginary[i] += wave.imag();
    }
}

void ExactSums::add_visible(const ScenePoint& point, const Visibility& visibility) {
    std::array<Vec3, tile_side> directions;
    std::array<bool, tile_side> hidden;
    for (std::size_t row = 0; row < region_.height; ++row) {
        const SampleRow samples = row_of(row);
        bool active = false;
        for (std::size_t i = 0; i < tile_side; ++i) {
            const Passage ray =
                unlimited_passage(point.position, {samples.x + static_cast<double>(i) * samples.pitch, samples.y, 0});
            directions[i] = ray.direction;
            active = active || !too_steep(ray, grid_);
        }
        if (!active) continue;
        visibility.hide(point.surface, directions, hidden);
        add_wave(point, grid_, samples, hidden.data(), real_[row].data(), imaginary_[row].data());
    }
}

// Without occlusion, [K] (3.5).
Field exact_points(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                   const Progress& progress) {
    const core::StopScope scope(progress);
    return sum_exactly(surface_points(scene, grid, options), grid, progress, add_all);
}

// With occlusion by one ray for each point and sample, [K] (3.6).
Field exact_visible_points(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                           const Progress& progress) {
    const core::StopScope scope(progress);
    const Visibility visibility(scene);
    return sum_exactly(surface_points(scene, grid, options), grid, progress,
                       [&](ExactSums& sums, const ScenePoint& point) { sums.add_visible(point, visibility); });
}

// Replaces surfaces by points along their edges, without occlusion. Source: Waters 1966.
Field points_along_edges(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                         const Progress& progress) {
    const core::StopScope scope(progress);
    return sum_exactly(edge_points(scene, grid, options), grid, progress, add_all);
}

}  // namespace hogel::direct
