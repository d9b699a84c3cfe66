// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/geometry.h"
#include "hogel/optics/spectrum.h"

namespace hogel::optics {

/// The orientation of a plane: its axes, orthogonal unit vectors, in the frame of another plane.
struct Orientation {
    Vec3 x{1, 0, 0}, y{0, 1, 0};

    Vec3 z() const { return cross(x, y); }
};

/// The same wave on a tilted plane through the window's centre ([K] 6.1.2): a rotation of its plane waves,
/// S'(f') = S(f) f_z/f'_z, where f is the frequency f' in the frame of the old plane and the factor is the Jacobian. S
/// is interpolated with an error of 1e-3. Directions that do not cross both planes towards their fronts are dropped.
/// @param spectrum  of a field that fills no more than half of its window, in x and in y, around the centre
/// @param window    the window on the new plane, whose size gives the frequency steps
/// @param band      the frequencies to compute on the new plane Throws Error(usage) for axes that are not orthogonal
///                  unit vectors, and for a band without frequencies.
Spectrum tilt(const Spectrum& spectrum, const Orientation& plane, const Grid& window, const Band& band,
              const ScratchOptions& scratch = {});

}  // namespace hogel::optics
