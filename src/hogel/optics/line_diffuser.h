// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/photograph.h"

namespace hogel::optics {

/// photograph_into() of a hologram's lines behind a vertical diffuser (docs/notation.md, section 4): the sum of the
/// intensities of its lines, each of which sends its light to all heights.
/// @param apart  distance of lines, in resolution cells beside the blur, at which their light counts as not
/// overlapping,
///               so that they share a photograph; infinity: a photograph for each line
void photograph_lines(const FieldSource& hologram, std::span<const Camera> cameras, const PhotographOptions& options,
                      std::span<Image> pictures, const Progress& progress, double apart = 32);

/// Throws what photograph_lines() throws before it begins.
void require_photographs_of_lines(const FieldGrid& hologram, std::span<const Camera> cameras,
                                  const PhotographOptions& options);

}  // namespace hogel::optics
