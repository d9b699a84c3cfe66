// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "hogel/core/stop_scope.h"
#include "hogel/direct/scene_points.h"
#include "hogel/work/parallel.h"

namespace hogel::direct {

// Horizontal parallax only, [K] 3.5. The hologram is cut into lines as high as the points' spacing; each receives only
// the light of points at its height. A line is constant over its height Ξ, so its light spreads vertically over about
// λ/Ξ, as sinc². At its middle a point of width w has radiance L if its wave has a² = L λ w/Ξ at unit distance and
// decays as 1/√r.
Field horizontal_lines(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                       const Progress& progress) {
    const core::StopScope scope(progress);
    validate(grid, ErrorCode::usage, "hologram");
    const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(options.spacing / grid.plane.pitch_y)));
    const double height = static_cast<double>(rows) * grid.plane.pitch_y;
    const std::size_t lines = (grid.plane.height + rows - 1) / rows;
    std::vector<std::vector<ScenePoint>> slices(lines);
    for (const ScenePoint& point : surface_points(scene, grid, options)) {
        const double line = std::floor((grid.plane.row(point.position.y) + 0.5) / static_cast<double>(rows));
        if (line >= 0 && line < static_cast<double>(lines)) slices[static_cast<std::size_t>(line)].push_back(point);
    }
    const Visibility visibility(scene);
    Field field(grid);
    progress.report(0);
    work::parallel_for(lines, [&](std::size_t line) {
        std::vector<std::complex<float>> values(grid.plane.width);
        for (std::size_t column = 0; column < values.size(); ++column) {
            core::throw_if_stopped();
            std::complex<double> sum = 0;
            for (const ScenePoint& point : slices[line]) {
                const Vec3 sample{grid.plane.x(static_cast<double>(column)), point.position.y, 0};
                const auto ray = passage(point.position, sample, grid);
                if (!ray || !visibility.is_visible(point.surface, ray->direction)) continue;
                const double cycles = ray->path / grid.wavelength + point.cycles;
                sum += std::polar(modulus(point, *ray) * std::sqrt(grid.wavelength * std::abs(ray->path)) / height,
                                  2 * std::numbers::pi * (cycles - std::round(cycles)));
            }
            values[column] = std::complex<float>(sum);
        }
        for (std::size_t row = line * rows; row < std::min((line + 1) * rows, grid.plane.height); ++row)
            std::ranges::copy(values, &field.samples(row, 0));
    });
    progress.report(1);
    return field;
}

}  // namespace hogel::direct
