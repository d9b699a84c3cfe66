// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "hogel/field.h"
#include "hogel/light_field.h"

namespace hogel::hologram::windows {

/// The factor, by depth, that corrects the amplitude of points shown by overlapping windows. Near the plane the windows
/// that show one point overlap and interfere, far from it they are separate. The factors are computed by adding up the
/// windows of one point in one dimension; they give points of all depths the energy that the light field's rays carry
/// in the middle of the fan of directions (docs/notation.md, section 3).
class WindowBrightness {
  public:
    /// @param hop     side of a hogel in samples
    /// @param window  values along one axis
    WindowBrightness(const LightFieldGrid& rays, const FieldGrid& grid, std::size_t hop, std::span<const float> window);

    float operator()(double depth) const;
    float farthest() const { return values_.back(); }  ///< for all depths beyond the table
    const std::vector<float>& values() const { return values_; }
    double steps_a_metre() const { return steps_a_metre_; }

  private:
    std::vector<float> values_;  // by |ζ|; the last value for all larger depths
    double steps_a_metre_;
};

}  // namespace hogel::hologram::windows
