// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "hogel/units.h"

namespace hogel::cli {

using namespace hogel::literals;

/// Every number that the command line takes where the user gives none. The hologram's side, its hogels and the
/// sharpness of a photograph belong together: a hogel is as wide as what the camera resolves, λR/A, or less.
struct Defaults {
    // light field
    std::string_view algorithm = "epi";
    std::string_view shading = "vertex";
    std::size_t shadow_map = 512;  ///< texels along a side of each of the six faces around a lamp
    double cache_spacing = 0.25;   ///< of points where light is worked out, in parts of a ray's width on the surface
    double size = 20_mm;           ///< side of the hologram
    std::size_t hogels = 400, directions = 32;
    double field_of_view = 16_deg;  ///< full angle, 2θ
    double front = 0.3;             ///< how much of a fitted mesh stands in front of the plane
    double sqnr = 40;               ///< decibels of a compressed light field
    double tone_decades = 1;        ///< of luminance, along a tone curve

    // baking
    std::size_t bake_rays = 256, bake_bounces = 5;

    // hologram
    double pitch = 1.5625_um;  ///< 32 samples a hogel; blue must still be diffracted over the field of view
    std::string_view basis = "cdf97";
    double spacing = 10_um;  ///< of points on surfaces
    std::size_t planes = 16;
    double red = 633_nm, green = 532_nm, blue = 460_nm;

    // camera
    std::string_view camera = "narrow";
    double eye_distance = 300_mm;
    double pupil = 6_mm;
    double focal_length = 50_mm;     ///< of a lens whose opening is given as an f-number
    double frame_rate = 12;          ///< of a film
    std::size_t resolution = 400;    ///< pixels across a photograph
    std::size_t looks = 16;          ///< photographs averaged against speckle
    std::size_t pupil_samples = 64;  ///< points of the pupil in a geometric photograph
};
inline constexpr Defaults defaults;

}  // namespace hogel::cli
