// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/camera/view_geometry.h"
#include "hogel/geometry.h"

namespace hogel::camera::narrow_band {

/// The sampling of one eye's narrow band of a hologram.
///
/// Light from the hologram point x that enters a pupil of diameter A around c has, after multiplication by
/// e^{+ik|x−c|}, a frequency of at most A/(2λr) (docs/notation.md section 4; r the distance). So few samples hold it.
struct BandGrid {
    ViewGeometry geometry;
    Grid plane;  ///< samples of the band; extends beyond the hologram by the half width of a kernel
};

}  // namespace hogel::camera::narrow_band
