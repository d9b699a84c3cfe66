#pragma once

#include <cstddef>
#include <cstdint>

#include "hogel/lightfield/light_field.h"
#include "hogel/math/vec.h"

namespace hogel {

/// Lengths counted in samples, so that the loops over samples work on small whole numbers. Column i of hogels has the
/// whole number n = i − ⌊S/2⌋, and a point (x, ζ) is seen by column n in the direction K = U/ΔU if n = x − K z, where
/// from here on x counts hogels from n = 0 and z = ζ ΔU/d. Directions that are not centred on U = 0 are counted from
/// their middle, and space is sheared to match. So K is a whole number or one and a half, exact as a float.
struct EpipolarFrame {
    double pitch, offset_s;     // d; x of column n = 0 is where the position's x / d is offset_s
    double step_u, step_ratio;  // ΔU, ΔV/ΔU
    double middle_u, middle_v;  // of the directions, in units of ΔU
    std::int32_t first_column;  // n of i = 0
    float first_direction;      // K of k = 0
    double first_row, first_v;  // t/d of row 0, V/ΔV of row 0

    explicit EpipolarFrame(const LightFieldGrid& grid)
        : pitch(grid.pitch),
          offset_s(grid.hogels_s % 2 == 0 ? 0.5 : 0.0),
          step_u(grid.step_u()),
          step_ratio(grid.step_v() / grid.step_u()),
          middle_u(grid.center_u / grid.step_u()),
          middle_v(grid.center_v / grid.step_u()),
          first_column(-static_cast<std::int32_t>(grid.hogels_s / 2)),
          first_direction(0.5f - 0.5f * static_cast<float>(grid.directions_u)),
          first_row(0.5 * static_cast<double>(grid.hogels_t) - 0.5),
          first_v(0.5 * static_cast<double>(grid.directions_v) - 0.5) {}

    Vec3 in_samples(Vec3 position) const {
        const double z = -position.z * step_u / pitch;
        return {position.x / pitch - offset_s - middle_u * z, position.y / pitch, z};
    }
    double metres_deep(double z) const { return z * pitch / step_u; }
    /// t/d of a row of hogels; the plane of epipolar row (t, V) is y = row(t) + slope(V) z.
    double row(std::size_t t) const { return first_row - static_cast<double>(t); }
    double slope(std::size_t v) const { return (first_v - static_cast<double>(v)) * step_ratio + middle_v; }
};

}  // namespace hogel
