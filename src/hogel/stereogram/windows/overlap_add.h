// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/field.h"
#include "hogel/hologram.h"
#include "hogel/light_field.h"
#include "hogel/stereogram/stereogram.h"

namespace hogel::stereogram::windows {

/// Returns the window layout of a hologram: windows at least two hogels wide, as large as the spacing of directions
/// allows, a multiple of the hogel's side (windows add up to a constant), and centred on the hogel.
HogelLayout window_layout(const LightFieldGrid& light_field, const FieldGrid& grid);

/// Makes a hologram of overlapping windows (OLAS).
/// @param plain  true: computes one hogel at a time, as always for large windows; false: sixteen at once where possible
std::shared_ptr<const FieldSource> make_overlap_add(const LightField& light_field, const FieldGrid& grid,
                                                    const HologramOptions& options, PointPhases phases,
                                                    bool plain = false);

}  // namespace hogel::stereogram::windows
