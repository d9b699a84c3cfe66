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

/// The distance of the points of a diffuse surface along x and along y, in hogels. Points that stood as the hogels do
/// would meet all of them alike, so that single directions of a plane parallel to the hologram were brighter than
/// others.
inline constexpr double point_spacing = 15.0 / 16;

/// The factors that correct the amplitudes of rays shown by overlapping windows, by direction and depth. Near the plane
/// the windows that show one point overlap and interfere, far from it they are separate. For each depth the windows of
/// one point, w_j for direction j, are set up along one axis as the hologram sets them up, and the factors b_j are
/// those for which every window has the energy of its ray in the sum of all, b_j Re⟨w_j, Σ_i b_i w_i⟩ = hop
/// (docs/notation.md, section 3). In two dimensions the windows of a point are
/// products, and so are the factors, but for the curvature of the spherical wave that mixes x and y.
///
/// Where all points have the same phase, the windows of different points interfere too. The factor of a depth, the same
/// for all directions, gives a uniform surface the power of the light field's rays: mean |F|² = L Δs_x Δs_y, where
/// Δs_x Δs_y is the fan's area in direction sines.
class WindowBrightness {
  public:
    /// The number of steps of depth.
    static constexpr std::size_t steps = 1024;

    /// @param hop     side of a hogel in samples
    /// @param window  values along one axis
    WindowBrightness(const LightFieldGrid& rays, const FieldGrid& grid, std::size_t hop, std::span<const float> window,
                     PointPhases phases);

    /// The step of a depth, which must be finite; the last one is for all larger depths.
    std::size_t step_of(float depth) const {
        const float at = std::min(std::abs(depth) * steps_a_metre_, static_cast<float>(steps - 1));
        return static_cast<std::size_t>(at);
    }
    /// Corrects a factor of one axis for the slope of the surface. Neighbouring hogels see a surface in one direction
    /// at points that are (1 + c) hogels apart, not one: where they lie closer, some points have two windows of this
    /// direction, which interfere, and where they lie farther apart some have none. A window interferes with itself by
    /// the share ρ of its energy in the sum, with its double by the same, and with those of other directions by the
    /// rest, in proportion to their number: the energy is (1 − ρ)/(1 + c) + ρ(1 + 2 max(0, −c)) of that without slope.
    float on_slope(float factor, float c) const {
        const float own = std::min(factor * factor * own_share_, 1.0f);
        return factor / std::sqrt((1 - own) / (1 + c) + own * (1 - 2 * std::min(c, 0.0f)));
    }
    /// The range of c of on_slope(): beyond it surfaces are seen almost along themselves, or depths are inexact.
    static constexpr float min_stretch = -0.4f, max_stretch = 1;
    /// One over the square of the factor of a window that interferes with no other.
    float own_share() const { return own_share_; }
    /// Where the factors of frequency j begin in across() and down().
    std::size_t first(std::ptrdiff_t j) const { return static_cast<std::size_t>(j + reach_) * steps; }
    const std::vector<float>& across() const { return across_; }
    const std::vector<float>& down() const { return down_; }
    float steps_a_metre() const { return steps_a_metre_; }

  private:
    std::ptrdiff_t reach_;              // frequencies are j = −reach … reach
    std::vector<float> across_, down_;  // [j + reach][step of |ζ|]
    float steps_a_metre_, own_share_;
};

}  // namespace hogel::stereogram::windows
