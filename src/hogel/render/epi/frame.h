// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "hogel/render/row_axes.h"

namespace hogel::render::epi {

/// Coordinates of epipolar planes. Lengths are in samples, so that loops over samples work on small integers. Column i
/// of S hogels has the integer n = i − ⌊S/2⌋. Column n sees a point (x, ζ) in the direction K = U/ΔU if n = x − K z,
/// where x counts hogels of pitch d from n = 0 and z = ζ ΔU/d. If the directions are not centred on U = 0, they are
/// counted from their middle and space is sheared accordingly. So K is a multiple of one half and exact as a float.
///
/// On a side of a hemicube the forward distance replaces ζ. It is relative to the row of hogels: z of a point minus z
/// of the row. On the left and right sides rows of hogels are columns (RowAxes), counted from the top like t.
class EpipolarFrame {
  public:
    explicit EpipolarFrame(const LightFieldGrid& grid)
        : grid_(grid),
          axes_(grid),
          step_(axes_.transposed() ? grid.step_v() : grid.step_u()),
          offset_(fast_count() % 2 == 0 ? 0.5 : 0.0),
          middle_fast_(axes_.transposed() ? -grid.center_v() / step_ : grid.center_u() / step_),
          middle_slow_((axes_.transposed() ? grid.center_u() : grid.center_v()) / step_),
          step_ratio_((axes_.transposed() ? grid.step_u() : grid.step_v()) / step_) {}

    const RowAxes& axes() const { return axes_; }
    /// Return n at i = 0 and K at k = 0.
    std::int32_t first_column() const { return -static_cast<std::int32_t>(fast_count() / 2); }
    float first_direction() const { return 0.5f - 0.5f * static_cast<float>(axes_.fast_directions()); }

    Vec3 in_samples(Vec3 position) const {
        const auto [fast, slow, forward] = axes_.seen(position, 0);
        const double z = forward * step_ / grid_.pitch;
        return {axes_.fast_sign() * fast / grid_.pitch - offset_ - middle_fast_ * z, slow / grid_.pitch, z};
    }
    /// Converts a forward distance to metres.
    double metres(double z) const { return z * grid_.pitch / step_; }

    /// Epipolar plane of one row of hogels and one row of directions: y = row + slope z for points in samples. The
    /// hogels of the row see them at (x + shift, z − z0).
    struct Plane {
        double row, slope, z0, shift;
        double depth_per_forward;  ///< ratio of ζ to the forward distance of a point
    };
    Plane plane(std::size_t hogel, std::size_t direction) const {
        const double i = static_cast<double>(hogel), k = static_cast<double>(direction);
        // Exact multiples of a half.
        const double row = axes_.transposed() ? i + 0.5 - 0.5 * static_cast<double>(grid_.hogels_s)
                                              : 0.5 * static_cast<double>(grid_.hogels_t) - i - 0.5;
        const double middle_k = axes_.transposed() ? k + 0.5 - 0.5 * static_cast<double>(grid_.directions_u)
                                                   : 0.5 * static_cast<double>(grid_.directions_v) - k - 0.5;
        const double slope = middle_k * step_ratio_ + middle_slow_;
        if (grid_.face() == Face::front) return {row, slope, 0, 0, 1};
        const Vec3 centre = axes_.transposed() ? Vec3{row, 0, 0} : Vec3{0, row, 0};
        const double z0 = axes_.seen(centre, 0).forward * step_;
        const double slow_direction = axes_.slow_direction(direction);
        const Vec3 ray =
            axes_.transposed() ? grid_.direction_of(slow_direction, 0) : grid_.direction_of(0, slow_direction);
        return {-slope * z0, slope, z0, middle_fast_ * z0, ray.z};
    }

  private:
    std::size_t fast_count() const { return axes_.transposed() ? grid_.hogels_t : grid_.hogels_s; }

    LightFieldGrid grid_;
    RowAxes axes_;
    double step_;                       // ΔU; ΔV on the left and right
    double offset_;                     // x / d of column n = 0
    double middle_fast_, middle_slow_;  // middle of the directions, in units of `step_`
    double step_ratio_;                 // step of the slow directions over `step_`
};

}  // namespace hogel::render::epi
