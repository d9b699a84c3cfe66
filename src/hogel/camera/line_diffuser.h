// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/photograph.h"

namespace hogel::camera {

/// The distance of lines, in resolution cells beside the blur, at which their light counts as not overlapping.
inline constexpr double lines_apart = 32;

/// photograph_into() of a hologram's lines behind a vertical diffuser (docs/notation.md, section 4): the sum of the
/// intensities of its lines, each of which sends its light to all heights.
/// @param apart  see lines_apart: lines so far apart share a photograph; infinity: a photograph for each line
void photograph_lines(const FieldSource& hologram, std::span<const Camera> cameras, const BandCamera& model,
                      std::span<Image> pictures, const Progress& progress, double apart = lines_apart);

/// Resources of photograph_lines() of so many looks. Throws what require_photographs_of_lines() throws.
Plan plan_lines(const FieldGrid& hologram, std::size_t looks, std::span<const Camera> cameras, const BandCamera& model);

/// Throws what photograph_lines() throws before it begins.
void require_photographs_of_lines(const FieldGrid& hologram, std::span<const Camera> cameras, const BandCamera& model);

}  // namespace hogel::camera
