#include <cmath>
#include <complex>
#include <numbers>

#include "hogel/direct/scene_points_internal.h"

namespace hogel {
namespace {

// The sum of the points' spherical waves sample by sample, over the points that the rule lets through.
template <class Rule>
Field sum_exactly(const std::vector<ScenePoint>& points, const FieldGrid& grid, const Progress& progress, Rule passes) {
    return sum_over_samples(grid, progress, [&](Vec3 place) {
        std::complex<double> sum = 0;
        for (const ScenePoint& point : points) {
            const auto ray = passage(point.position, place, grid);
            if (!ray || !passes(point, place, ray->way)) continue;
            const double turns = ray->path / grid.wavelength + point.turns;
            sum += std::polar(modulus(point, *ray), 2 * std::numbers::pi * (turns - std::round(turns)));
        }
        return sum;
    });
}

bool always(const ScenePoint&, Vec3, Vec3) { return true; }

}  // namespace

// [K] (3.5): everything shines through everything.
Field exact_points(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                   const Progress& progress) {
    return sum_exactly(surface_points(scene, grid, options), grid, progress, always);
}

// [K] (3.6): a ray for each point and sample.
Field exact_visible_points(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                           const Progress& progress) {
    const Visibility visibility(scene);
    return sum_exactly(surface_points(scene, grid, options), grid, progress,
                       [&](const ScenePoint& point, Vec3, Vec3 way) { return visibility.sees(point.surface, way); });
}

// Surfaces are given up for the points along their edges, which shine through everything. Source: Waters 1966.
Field points_along_edges(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                         const Progress& progress) {
    return sum_exactly(edge_points(scene, grid, options), grid, progress, always);
}

}  // namespace hogel
