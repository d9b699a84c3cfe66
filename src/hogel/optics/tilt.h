// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/geometry.h"
#include "hogel/optics/spectrum.h"

namespace hogel::optics {

/// The orientation of a plane: its axes, unit vectors at right angles, in the frame of another plane.
struct Orientation {
    Vec3 x{1, 0, 0}, y{0, 1, 0};

    Vec3 z() const { return cross(x, y); }
};

/// The same wave on a tilted plane through the window's centre ([K] 6.1.2): a rotation of its plane waves,
/// S'(f') = S(f) f_z/f'_z, f being the frequency f' as seen from the old plane; the factor is the Jacobian.
/// Between samples S is interpolated to 1e-3. Directions that do not cross both planes towards their fronts are
/// dropped.
/// @param spectrum  of a field that fills no more than half of its window, in x and in y, around the centre
/// @param window    of the new plane: its count and pitch; its size gives the steps of frequency
/// @param band      the frequencies on the new plane that are wanted
/// Throws Error(usage) for axes that are not unit vectors at right angles, and for a band with nothing in it.
Spectrum tilt(const Spectrum& spectrum, const Orientation& plane, const Grid& window, const Band& band,
              const ScratchOptions& scratch = {});

}  // namespace hogel::optics
