// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/field.h"
#include "hogel/hologram.h"
#include "hogel/light_field.h"

namespace hogel::hologram::windows {

/// Makes a hologram of overlapping windows (OLAS).
/// @param one_by_one  use the plain version, which is always used for large windows; the fast one computes the windows
///                    of many hogels at once
std::shared_ptr<const FieldSource> make_overlap_add(const LightField& light_field, const FieldGrid& grid,
                                                    const HologramOptions& options, PointPhases phases,
                                                    bool one_by_one = false);

}  // namespace hogel::hologram::windows
