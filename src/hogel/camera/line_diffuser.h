// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/photograph.h"

namespace hogel::camera {

/// Distance beyond the blur, in resolution cells, at which the light of two lines counts as not overlapping.
inline constexpr double lines_apart = 32;

/// Implements photograph_into() for a hologram behind a vertical diffuser (docs/notation.md, section 4): the sum of the
/// intensities of its lines, each of which sends its light to all heights.
/// @param separation  lines at least this far apart share a photograph, see lines_apart; infinity: a photograph per
///                    line
void photograph_lines(const FieldSource& hologram, std::span<const Camera> cameras, const BandCamera& model,
                      std::span<Image> pictures, const Progress& progress, double separation = lines_apart);

/// Returns the resources of photograph_lines() of `looks` looks. Throws what require_photographs_of_lines() throws.
Plan plan_lines(const FieldGrid& hologram, std::size_t looks, std::span<const Camera> cameras, const BandCamera& model);

/// Throws the errors that photograph_lines() throws before it begins.
void require_photographs_of_lines(const FieldGrid& hologram, std::span<const Camera> cameras, const BandCamera& model);

}  // namespace hogel::camera
