// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "hogel/camera.h"
#include "hogel/image.h"
#include "hogel/light_field.h"

namespace hogel {

/// The photograph of a light field by geometric optics: for each pixel the mean radiance over the pupil of the rays
/// that meet at the pixel's point of the plane in focus. The truth that a hologram's photograph is compared with.
/// Linear interpolation in all four dimensions; rays outside the hologram or the field of view are black.
/// @param pupil_samples  points of the pupil, spread evenly over the disc
/// Memory: one picture a camera and a tile of hogels. Cost: pupil samples × (hogels + pixels) a camera.
std::vector<Image> photograph(const LightFieldSource& light_field, std::span<const Camera> cameras,
                              std::size_t pupil_samples = 64, const Progress& progress = {});

/// The same of several light fields of the same hogels, such as the faces of a hemicube: a ray is looked up in the
/// first of them that has its direction. Throws Error(usage) where there is none, or where hogels or channels differ.
std::vector<Image> photograph(std::span<const LightFieldSource* const> faces, std::span<const Camera> cameras,
                              std::size_t pupil_samples = 64, const Progress& progress = {});

}  // namespace hogel
