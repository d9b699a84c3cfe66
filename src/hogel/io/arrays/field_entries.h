// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/files.h"

namespace hogel::io::arrays {

/// Sets pitch, wavelengths, values and phase code from field_entries() texts of `facts.colours` fields.
void take_entries(const Metadata& entries, ExternalFacts& facts);

/// Returns the light power |F|² on a pattern of one wavelength, as stated by `hogel slm`; 0 if not stated.
double power_of_pattern(const Metadata& entries, double wavelength);

}  // namespace hogel::io::arrays
