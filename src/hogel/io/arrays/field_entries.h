// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/files.h"

namespace hogel::io::arrays {

/// Takes what the texts of field_entries() say of `facts.colours` fields: pitch, wavelengths, values and phase code.
void take_entries(const Metadata& entries, ExternalFacts& facts);

/// The power of the light on a pattern of one wavelength that shows the hologram, |F|², as `hogel slm` states it; 0
/// where the texts say none.
double power_of_pattern(const Metadata& entries, double wavelength);

}  // namespace hogel::io::arrays
