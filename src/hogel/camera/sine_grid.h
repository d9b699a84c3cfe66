// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include "hogel/camera.h"
#include "hogel/camera/narrow_band/band_grid.h"

namespace hogel::camera {

/// Directions from the centre of a lens at uniform steps of their sines (n_x, n_y): the sampling of the film. A Fourier
/// transform over these sines gives the light in the plane of the pupil, at any obliquity.
struct SineGrid {
    std::size_t size_x = 0, size_y = 0;  ///< number of samples, a good size for a transform
    double first_x = 0, first_y = 0;     ///< sine of the first sample; n_x grows with the column, n_y with the row
    double step = 0;                     ///< between samples

    struct Range {
        double low = 0, high = 0;
        double span() const { return high - low; }
    };
    Range x, y;              ///< sines of the hologram
    Range shown_x, shown_y;  ///< sines of the area on the film, which contains the hologram

    double period_x() const { return static_cast<double>(size_x) * step; }
    double period_y() const { return static_cast<double>(size_y) * step; }
    /// Returns the distance, in sines, by which light may spread on the film before it wraps around to a shown part.
    double room() const { return std::min(period_x() - farthest(x, shown_x), period_y() - farthest(y, shown_y)); }
    /// Returns the largest distance of a shown sine from one of the hologram.
    static double farthest(const Range& hologram, const Range& shown) {
        return std::max(hologram.high - shown.low, shown.high - hologram.low);
    }
};

/// Returns the area that a film shows: the hologram, and the part of its surroundings that receives light and is in the
/// pictures. It is bitwise the rectangle of the hologram if the pictures show no surroundings.
/// @param pictures  bounding rectangle of all pictures
/// @param active    area that receives light of the hologram
Rectangle film_area(const Grid& hologram, const Rectangle& pictures, const Rectangle& active);

/// Returns a grid no coarser than the band, with room beside the shown area for all light that a camera follows.
/// @param shown  film_area()
/// @param pupil  largest diameter, metres
/// @param blur   spread of light out of focus, in sines, see defocus_blur()
SineGrid sine_grid(const narrow_band::BandGrid& band, const Grid& plane, const Rectangle& shown, double pupil,
                   double blur);

/// Returns a grid of one sample that covers a rectangle.
Grid as_grid(const Rectangle& rectangle);

struct SineRanges {
    SineGrid::Range x, y;
};
SineRanges sines_of(const ViewGeometry& geometry, const Grid& plane);

/// Returns the largest width in the picture, in direction sines, of the blur disc of a point of the hologram plane.
double defocus_blur(const Camera& camera);

}  // namespace hogel::camera
