// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/camera/view_geometry.h"
#include "hogel/geometry.h"

namespace hogel::camera::narrow_band {

/// Sampling of a viewpoint's narrow band of a hologram.
///
/// Light from the hologram point x that enters a pupil of diameter A around c has, after multiplication by
/// e^{+ik|x−c|}, a frequency of at most A/(2λr), with the distance r (docs/notation.md section 4). So few samples
/// represent it.
struct BandGrid {
    ViewGeometry geometry;
    Grid plane;  ///< samples of the band, which extends beyond the hologram by half the width of a kernel
};

}  // namespace hogel::camera::narrow_band
