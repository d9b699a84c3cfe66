// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/exchange/view_set.h"

namespace hogel::exchange {

/// Position of a hogel in each view, in pixels of the view, possibly fractional: hogel (i, j) reads view (row, column)
/// at x = x0 + i + dx·column, y = y0 + step_y·j + dy·row. step_y differs from 1 if pixels are not square.
struct Shear {
    double x0 = 0, y0 = 0, dx = 0, dy = 0, step_y = 1;
    std::size_t width = 0, height = 0;  ///< size of the area that all views show, pixels
};

/// Geometry of a set of views at the hologram.
struct Placement {
    LightFieldGrid grid;
    Shear shear;
    double spacing = 0, spacing_y = 0,
           distance = 0;  ///< of the cameras, metres at the hologram; of orthographic views 0
    double scale = 0;     ///< distance at the hologram per distance in the set; 0 if the set does not state its size
    std::vector<std::string> assumed;
};

/// Computes the placement of a set. For cameras, options.disparity selects the plane that becomes the hologram: with
/// camera spacing b, distance D of the zero-parallax plane and pixel tangent a, its distance D' satisfies 1/D' = 1/D +
/// disparity a/b, and its pixel pitch is a D'. Throws Error(usage) for conflicting options or a plane that does not
/// exist, and Error(bad_input) for a geometry of the set that no light field has.
Placement place(const ViewSet& set, const ViewImportOptions& options);

/// Returns a one-line description of the geometry.
std::string describe(const ViewSet& set, const Placement& placement, double parallax);

}  // namespace hogel::exchange
