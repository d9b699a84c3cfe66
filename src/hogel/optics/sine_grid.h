// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/camera.h"
#include "hogel/optics/narrow_band/narrow_band.h"

namespace hogel::optics {

/// Directions from the centre of a lens at uniform steps of their sines (n_x, n_y): the sampling of the film, in which
/// the pupil is the plane of the Fourier transform at any obliquity.
struct SineGrid {
    std::size_t size_x = 0, size_y = 0;  ///< number of samples, a good size for a transform
    double first_x = 0, first_y = 0;     ///< sine of the first sample; n_x grows with the column, n_y with the row
    double step = 0;                     ///< between samples

    std::size_t samples() const { return size_x * size_y; }
};

/// A grid that covers what the eye sees of a plane, no coarser than its band, with a margin for light out of focus.
/// @param blur  the spread of light out of focus in the sines, see defocus_blur()
SineGrid sine_grid(const narrow_band::NarrowBand& band, const Grid& plane, double blur);

/// The largest width in the picture, in direction sines, of the blur disc of a point of the hologram plane.
double defocus_blur(const Camera& camera);

}  // namespace hogel::optics
