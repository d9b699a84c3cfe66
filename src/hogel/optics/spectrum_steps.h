// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/optics/spectrum.h"

namespace hogel::optics {

/// Returns a spectrum of zeros. It has the frequencies of `band` (cycles per metre) that samples at the window's pitch
/// represent around a carrier. Throws Error(usage) if there are none.
Spectrum empty_spectrum(const Grid& window, double wavelength, const Band& band, double carrier_x, double carrier_y,
                        const ScratchOptions& scratch);

}  // namespace hogel::optics
