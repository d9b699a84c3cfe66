// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "hogel/field.h"
#include "hogel/light_field.h"

namespace hogel::hologram::windows {

/// The factor by which overlapping windows must raise the amplitude of points, by depth. Near the plane the windows
/// that show one point overlap and interfere, far from it they lie apart. The factors are found by adding up one
/// point's windows, in one dimension: they give points of all depths, in the middle of the fan of directions, the
/// energy that the light field's rays carry there (docs/notation.md, section 3).
class WindowBrightness {
  public:
    /// @param hop     samples of a hogel's side
    /// @param window  along a line
    WindowBrightness(const LightFieldGrid& rays, const FieldGrid& grid, std::size_t hop, std::span<const float> window);

    float operator()(double depth) const;
    float farthest() const { return values_.back(); }  ///< of all depths beyond the table
    const std::vector<float>& values() const { return values_; }
    double steps_a_metre() const { return steps_a_metre_; }

  private:
    std::vector<float> values_;  // by |ζ|, the last for all beyond
    double steps_a_metre_;
};

}  // namespace hogel::hologram::windows
