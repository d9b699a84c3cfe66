// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/pattern.h"

namespace hogel::patterns {

/// A pupil in the Fourier plane behind a modulator, and the depth in focus. Its photograph is orthographic: all parts
/// of the modulator are seen in the same directions.
struct Pupil {
    Aperture aperture;
    double focus = 0;               ///< depth ζ, metres
    std::size_t size = 0;           ///< index of the radius, below PupilRange::radii
    double axis_x = 0, axis_y = 0;  ///< frequency of light along the camera's axis, cycles per pixel
};

/// Range of pupils whose photographs show a light field: those within its directions, in focus within its depths.
struct PupilRange {
    static constexpr std::size_t radii = 8;  ///< number of different radii

    Aperture directions;               ///< centre of the light field's directions, cycles per pixel
    double half_x = 0, half_y = 0;     ///< half the width and height of the directions, cycles per pixel
    double nearest = 0, farthest = 0;  ///< depths ζ, metres

    /// Returns radius `size` of the pupils, cycles per pixel: from a sixth to three eighths of the directions' smaller
    /// half.
    double radius(std::size_t size) const;
    /// Returns pupil `index` of a sequence of random ones: each with an independent radius, place and focus.
    Pupil draw(std::uint32_t sequence, std::uint32_t index) const;
};

}  // namespace hogel::patterns
