// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/geometry.h"
#include "hogel/optics/spectrum.h"

namespace hogel::optics {

/// The orientation of a plane: orthogonal unit vectors along its axes, in the frame of another plane.
struct Orientation {
    Vec3 x{1, 0, 0}, y{0, 1, 0};

    Vec3 z() const { return cross(x, y); }
};

/// Returns the same wave on a tilted plane through the centre of the window ([K] 6.1.2): a rotation of its plane waves,
/// S'(f') = S(f) f_z/f'_z. f is the frequency f' in the frame of the old plane; the factor is the Jacobian. S is
/// interpolated with an error of 1e-3. Directions that do not cross both planes towards their fronts are dropped.
/// Throws Error(usage) for axes that are not orthogonal unit vectors, and for a band without frequencies.
/// @param spectrum  of a field that fills at most half of its window, in x and in y, around the centre
/// @param window    the window on the new plane; its size determines the frequency steps
/// @param band      the frequencies to compute on the new plane
Spectrum tilt(const Spectrum& spectrum, const Orientation& plane, const Grid& window, const Band& band,
              const ScratchOptions& scratch = {});

}  // namespace hogel::optics
