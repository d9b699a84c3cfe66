// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "hogel/field.h"
#include "hogel/hologram.h"
#include "hogel/light_field.h"

namespace hogel::stereogram::windows {

/// Distance of the points of a diffuse surface along x and y, in hogels. At a distance of one hogel all points would
/// coincide with hogels alike, and some directions of a plane parallel to the hologram would be brighter.
inline constexpr double point_spacing = 15.0 / 16;

/// Amplitude factors of rays shown by overlapping windows, by direction and depth. Near the plane the windows of one
/// point overlap and interfere; far from it they are separate. For each depth the windows of a point, w_j for direction
/// j, are set up along one axis as in the hologram. The factors b_j give every window the energy of its ray in the sum
/// of all: b_j Re⟨w_j, Σ_i b_i w_i⟩ = hop (docs/notation.md, section 3). In two dimensions windows and factors are
/// products, apart from the curvature of the spherical wave that mixes x and y.
///
/// If all points have the same phase, windows of different points interfere too. The factor of a depth, the same for
/// all directions, then gives a uniform surface the power of the light field's rays: mean |F|² = L Δs_x Δs_y, with Δs_x
/// Δs_y the fan's area in direction sines.
class WindowBrightness {
  public:
    static constexpr std::size_t steps = 1024;  ///< number of depth steps

    /// @param hop     side of a hogel in samples
    /// @param window  values along one axis
    WindowBrightness(const LightFieldGrid& rays, const FieldGrid& grid, std::size_t hop, std::span<const float> window,
                     PointPhases phases);

    /// Returns the step of a depth, which must be finite; the last step holds all larger depths.
    std::size_t step_of(float depth) const {
        const float step = std::min(std::abs(depth) * steps_a_metre_, static_cast<float>(steps - 1));
        return static_cast<std::size_t>(step);
    }
    /// Corrects a factor of one axis for the slope of the surface. Neighbouring hogels see a surface in one direction
    /// at points (1 + c) hogels apart. Closer points (c < 0) can have two interfering windows of this direction; more
    /// distant ones can have none. A window interferes with itself by the share ρ of its energy in the sum, with its
    /// double by the same, and with other directions by the rest, in proportion to their number. The energy is (1 −
    /// ρ)/(1 + c) + ρ(1 + 2 max(0, −c)) of that without slope.
    float on_slope(float factor, float c) const {
        const float rho = std::min(factor * factor * isolated_share_, 1.0f);
        return factor / std::sqrt((1 - rho) / (1 + c) + rho * (1 - 2 * std::min(c, 0.0f)));
    }
    /// Range of c in on_slope(); beyond it surfaces are almost parallel to the ray, or depths are inexact.
    static constexpr float min_stretch = -0.4f, max_stretch = 1;
    /// Returns 1/b² with b the factor of a window that interferes with no other.
    float isolated_share() const { return isolated_share_; }
    /// Returns the offset of the factors of frequency j in across() and down().
    std::size_t first(std::ptrdiff_t j) const { return static_cast<std::size_t>(j + max_frequency_) * steps; }
    const std::vector<float>& across() const { return across_; }
    const std::vector<float>& down() const { return down_; }
    float steps_a_metre() const { return steps_a_metre_; }

  private:
    std::ptrdiff_t max_frequency_;      // frequencies are j = −max_frequency_ … max_frequency_
    std::vector<float> across_, down_;  // [j + max_frequency_][step of |ζ|]
    float steps_a_metre_, isolated_share_;
};

}  // namespace hogel::stereogram::windows
