// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/exchange/view_set.h"

namespace hogel::exchange {

/// Which pixels of each view become hogels. View (row, column) is read at x = x0 + i + dx·column, y = y0 + j + dy·row
/// for hogel (i, j); rows of pixels that are not square are `step_y` apart instead of 1.
struct Shear {
    double x0 = 0, y0 = 0, dx = 0, dy = 0, step_y = 1;
    std::size_t width = 0, height = 0;  ///< of what all views show
};

/// A set of views at the hologram.
struct Placement {
    LightFieldGrid grid;
    Shear shear;
    double spacing = 0, spacing_y = 0,
           distance = 0;  ///< of the cameras, metres at the hologram; of orthographic views 0
    double scale = 0;     ///< 0 where the set does not say its size
    std::vector<std::string> assumed;
};

/// Where a set goes. For cameras, the plane that becomes the hologram is the one of options.disparity: with the spacing
/// b, the distance D of the plane on which views agree and the tangent a between pixels, it is at D' with 1/D' = 1/D +
/// disparity a/b, and its pixels are a D' apart. Throws Error(usage) for options that do not go together or a plane
/// that is nowhere, and Error(bad_input) for a geometry of the set's own that no light field has.
Placement place(const ViewSet& set, const ViewImportOptions& options);

/// The geometry as understood, one line.
std::string describe(const ViewSet& set, const Placement& placement, double parallax);

}  // namespace hogel::exchange
