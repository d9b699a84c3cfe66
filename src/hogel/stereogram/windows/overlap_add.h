// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/field.h"
#include "hogel/hologram.h"
#include "hogel/light_field.h"
#include "hogel/stereogram/stereogram.h"

namespace hogel::stereogram::windows {

/// The windows of a hologram of this grid: at least two hogels wide, as large as the spacing of directions allows, a
/// multiple of the hogel's side so that windows add up to a constant, and such that the window is centred on the hogel.
HogelLayout window_layout(const LightFieldGrid& light_field, const FieldGrid& grid);

/// Makes a hologram of overlapping windows (OLAS).
/// @param one_by_one  use the plain version, which is always used for large windows; the fast one computes the windows
///                    of many hogels at once
std::shared_ptr<const FieldSource> make_overlap_add(const LightField& light_field, const FieldGrid& grid,
                                                    const HologramOptions& options, PointPhases phases,
                                                    bool one_by_one = false);

}  // namespace hogel::stereogram::windows
