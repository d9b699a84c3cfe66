// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/points.h"

#include <cmath>
#include <numbers>

#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::stereogram {

Field point_hologram(std::span<const PointSource> points, const FieldGrid& grid) {
    validate(grid, ErrorCode::usage, "point hologram");
    for (const PointSource& point : points)
        if (!(point.position.z != 0) || !std::isfinite(length(point.position)))
            throw Error(ErrorCode::usage,
                        "point hologram: a point lies on the hologram plane, where its wave is singular");
    Field field(grid);
    const double k = 2 * std::numbers::pi / grid.wavelength;
    work::parallel_for(grid.plane.height, [&](std::size_t row) {
        for (std::size_t column = 0; column < grid.plane.width; ++column) {
            const Vec3 sample{grid.plane.x(static_cast<double>(column)), grid.plane.y(static_cast<double>(row)), 0};
            std::complex<double> sum = 0;
            for (const PointSource& point : points) {
                const double r = length(sample - point.position);
                // The wave diverges from a point behind the plane (z < 0). It converges to a point in front of the
                // plane and arrives there with the point's phase.
                const double travelled = point.position.z < 0 ? r : -r;
                sum += std::polar(point.amplitude / r, k * travelled + point.phase);
            }
            field.samples(row, column) = std::complex<float>(sum);
        }
    });
    return field;
}

}  // namespace hogel::stereogram
