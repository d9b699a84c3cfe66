// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/field.h"
#include "hogel/hologram.h"
#include "hogel/light_field.h"

namespace hogel::hologram::windows {

/// Stereograms whose windows overlap. One by one is the plain way, which is always taken where windows are large; the
/// other makes windows of many hogels at once.
std::unique_ptr<FieldSource> make_overlap_add(const LightFieldSource& light_field, const FieldGrid& grid,
                                              const HologramOptions& options, bool one_by_one = false);

}  // namespace hogel::hologram::windows
