// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include "hogel/camera.h"
#include "hogel/camera/narrow_band/band_grid.h"

namespace hogel::camera {

/// Directions from the centre of a lens at uniform steps of their sines (n_x, n_y): the sampling of the film, in which
/// the pupil is the plane of the Fourier transform at any obliquity.
struct SineGrid {
    std::size_t size_x = 0, size_y = 0;  ///< number of samples, a good size for a transform
    double first_x = 0, first_y = 0;     ///< sine of the first sample; n_x grows with the column, n_y with the row
    double step = 0;                     ///< between samples

    struct Range {
        double low = 0, high = 0;
        double span() const { return high - low; }
    };
    Range x, y;              ///< the sines of the hologram
    Range shown_x, shown_y;  ///< the sines of what the film shows, which are those of the hologram at least

    double period_x() const { return static_cast<double>(size_x) * step; }
    double period_y() const { return static_cast<double>(size_y) * step; }
    /// The distance that light may travel from its point of the hologram, in sines, without wrapping around to a place
    /// that the film shows.
    double room() const { return std::min(period_x() - farthest(x, shown_x), period_y() - farthest(y, shown_y)); }
    /// The largest distance of a shown sine from one of the hologram.
    static double farthest(const Range& hologram, const Range& shown) {
        return std::max(hologram.high - shown.low, shown.high - hologram.low);
    }
};

/// What a film shows: the hologram, and what pictures show of the surroundings that its light reaches. The rectangle of
/// the hologram, bit by bit, where they show no surroundings.
/// @param pictures  a rectangle around all pictures
/// @param lit       where light of the hologram arrives
Rectangle film_area(const Grid& hologram, const Rectangle& pictures, const Rectangle& active);

/// A grid no coarser than its band, with room beside what the film shows for all light that a camera follows.
/// @param shown  film_area()
/// @param pupil  the widest, metres
/// @param blur   the spread of light out of focus in the sines, see defocus_blur()
SineGrid sine_grid(const narrow_band::BandGrid& band, const Grid& plane, const Rectangle& shown, double pupil,
                   double blur);

/// A grid of one sample.
Grid as_grid(const Rectangle& rectangle);

/// The sines of a plane.
struct SineRanges {
    SineGrid::Range x, y;
};
SineRanges sines_of(const ViewGeometry& geometry, const Grid& plane);

/// The largest width in the picture, in direction sines, of the blur disc of a point of the hologram plane.
double defocus_blur(const Camera& camera);

}  // namespace hogel::camera
